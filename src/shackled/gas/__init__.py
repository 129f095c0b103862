"""What a picture costs: exactly, by a search over gas limits, by stage and by line, and where it fits."""
