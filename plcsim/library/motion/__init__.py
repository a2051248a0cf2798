"""Drives as a simple model: what blocks of PLCopen motion and of mapp command, axes do here.

The declarations of ACP10_MC, McAxis and MpAxis come with a project, compiled bodies are the
vendor's. So that the logic of a machine leaves its first state, the blocks that projects use most
move a model: an axis follows trapezoidal profiles, and blocks report as PLCopen has it.
"""
