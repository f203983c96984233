"""Round every page: the router, the line on top, the sidebar."""
