"""Make the scenes with which the original contracts were measured, and measure a user's own copy of these contracts."""
