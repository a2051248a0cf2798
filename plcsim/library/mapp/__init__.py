"""Models of components of mapp Services, behind whatever declarations a project brings of them."""
