"""Bytes to and from peers: the thesis' socket over AsTCP, links, the bounded step."""
