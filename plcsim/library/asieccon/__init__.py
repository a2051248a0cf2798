"""Library AsIecCon: conversions between all elementary types, and the order of bytes.

Programs in Structured Text know the conversions of numbers by themselves; what stands here is for
the other languages, and for texts in all of them.
"""
