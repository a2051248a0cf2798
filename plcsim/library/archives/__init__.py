"""AsZip: archives on the devices of FileIO."""
