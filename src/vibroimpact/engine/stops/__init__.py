"""The stops of one mass, a file a kind: what does not depend on how a flow finds a motion."""
