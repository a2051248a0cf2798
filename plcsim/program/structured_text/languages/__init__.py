"""The languages of the front end beside Structured Text: each becomes its syntax tree."""
