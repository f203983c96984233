"""Many loops: rows, chunks, executors, tables, the command and the report."""
