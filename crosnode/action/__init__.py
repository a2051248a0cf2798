"""Actions (actionlib): goals that take time, with feedback, a result, and a way to stop them."""
