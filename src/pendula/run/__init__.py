"""One motion: solved step by step or in closed form, its events, sections and trust horizon."""
