"""Programs that make the documentation: its pictures, its tables, and hooks of mkdocs."""
