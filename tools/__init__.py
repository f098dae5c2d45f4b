"""What maintains the repository; nothing of the package needs it."""
