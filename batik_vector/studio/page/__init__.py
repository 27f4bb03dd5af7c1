"""The page of the studio, made of NiceGUI's parts: what is shown, and what it can be told to do."""
