from ._instance import Answer, Instance, Status
from ._module import module_bytes

__all__ = ["Answer", "Instance", "Status", "module_bytes"]
