"""A zip archive of a stranger, unpacked into a folder: few files, of bounded size, whose names stay inside."""

from __future__ import annotations

import io
import stat
import zipfile
from pathlib import Path, PurePosixPath

from ..errors import InputError
from ..scene import READERS, SCENES
from .limits import MEGABYTE, Limits

_CHUNK = 1 << 16
#: Folders in folders, and characters of a name.
_DEPTH, _NAME = 6, 120


def unpack(data: bytes, folder: Path, limits: Limits, what: str = "the archive") -> Path:
    """Unpacks an archive; the mesh or scene file in it. InputError if there is not just one, or anything is wrong.

    A scene file comes before the meshes that it may be made of. what: the archive is called in messages.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            names = _checked(archive, limits, what)
            left = limits.unpacked
            for name, entry in names.items():
                target = folder.joinpath(*name.parts)
                target.parent.mkdir(parents=True, exist_ok=True)
                left = _extract(archive, entry, target, left, limits.unpacked)
    except (zipfile.BadZipFile, zipfile.LargeZipFile, EOFError, NotImplementedError, RuntimeError, OSError) as error:
        raise InputError(f"{what} cannot be unpacked: {' '.join(str(error).split())[:100]}") from None
    except ValueError as error:
        if isinstance(error, InputError):
            raise
        raise InputError("the archive cannot be unpacked") from None
    except Exception as error:  # zlib.error, LZMAError: each way of packing has its own
        raise InputError(f"the archive is damaged: {' '.join(str(error).split())[:100]}") from None
    return folder.joinpath(*_main(list(names), what).parts)


def _checked(archive: zipfile.ZipFile, limits: Limits, what: str) -> dict[PurePosixPath, zipfile.ZipInfo]:
    entries = [entry for entry in archive.infolist() if not entry.is_dir()]
    if len(entries) > limits.entries:
        raise InputError(f"{what} has {len(entries):,} files; up to {limits.entries} are read")
    whole = sum(entry.file_size for entry in entries)
    if whole > limits.unpacked:
        raise InputError(
            f"{what} holds {whole / MEGABYTE:,.0f} MB; up to {limits.unpacked / MEGABYTE:.0f} MB are unpacked"
        )
    names: dict[PurePosixPath, zipfile.ZipInfo] = {}
    for entry in entries:
        name = PurePosixPath(entry.filename.replace("\\", "/"))
        if name.is_absolute() or ".." in name.parts or ":" in entry.filename or "\0" in entry.filename:
            raise InputError(f"the archive has a file that wants to lie outside of it: {entry.filename!r:.80}")
        if len(name.parts) > _DEPTH or any(len(part) > _NAME for part in name.parts):
            raise InputError(f"the archive has a file of too long a name: {entry.filename!r:.80}")
        if stat.S_ISLNK(entry.external_attr >> 16):
            raise InputError(f"the archive has a link, {entry.filename!r:.80}; put the file itself into it")
        if entry.flag_bits & 1:
            raise InputError("the archive is encrypted; pack it without a password")
        if not _is_hidden(name):
            names[name] = entry
    return names


def _extract(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, target: Path, left: int, bound: int) -> int:
    """Unpacks one file; the bytes that others may still have. What the archive says of its size is not trusted."""
    with archive.open(entry) as packed, target.open("xb") as file:
        while chunk := packed.read(_CHUNK):
            left -= len(chunk)
            if left < 0:
                raise InputError(f"the archive holds more than the {bound / MEGABYTE:.0f} MB that are unpacked")
            file.write(chunk)
    return left


def _main(names: list[PurePosixPath], what: str) -> PurePosixPath:
    for known in (SCENES, tuple(READERS)):
        found = [name for name in names if name.suffix.lower() in known]
        if len(found) == 1:
            return found[0]
        if found:
            shown = ", ".join(str(name) for name in found[:4])
            raise InputError(f"{what} has {len(found)} files that could be meant ({shown:.120}); leave one in it")
    raise InputError(f"{what} has no mesh or scene file: {', '.join((*READERS, *SCENES))}")


def _is_hidden(name: PurePosixPath) -> bool:
    return name.parts[0] == "__MACOSX" or any(part.startswith(".") for part in name.parts)
