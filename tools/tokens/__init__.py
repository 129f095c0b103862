"""Deploy the collections on a chain in this process."""
