"""Library iec: counters, timers, dates and conversions of IEC 61131-3 beside the library standard.

Its bodies are Structured Text (``iec.st``), compiled like those of a project's libraries.
"""
