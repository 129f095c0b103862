"""The page of the Creator: its server, its templates, and what happens in the browser (`assets`)."""
