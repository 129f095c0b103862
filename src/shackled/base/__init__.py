"""What all packages use: checks of arguments, values, files, processes, and synonyms of keywords."""
