"""Models of closed loops: blocks of LoopConR behind whatever declarations a project brings of them.

What they calculate is what the vendor's training texts say of controllers and delays; how the
vendor rounds is not known.
"""
