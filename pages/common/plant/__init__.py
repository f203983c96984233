"""The plant page: entry and views of a plant."""
