"""The one home of a key of a study: its entry, the names it allows, how values are checked and told, the schema."""
