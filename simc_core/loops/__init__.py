"""Plant and controller closed to a loop, single and nested: the block diagrams that fix all signs."""
