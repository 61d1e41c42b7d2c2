"""What is made of results: pictures, and later all files that a run writes."""
