"""One page for a loop, to be printed and kept: everything is made from one record."""
