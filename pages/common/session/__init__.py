"""The design of this session: as a record, in the address, in a project file, in the session state."""
