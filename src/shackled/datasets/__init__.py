"""Models that come with the package or are fetched on request."""
