"""Services: processes beside the scan that talk to the world, and only here asyncio is at home."""
