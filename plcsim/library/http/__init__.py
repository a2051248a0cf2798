"""AsHttp: a client over the controller's network, and conversions of texts."""
