"""Recordings of real pendulums: read, fitted, compared with models."""
