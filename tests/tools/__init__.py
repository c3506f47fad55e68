"""What tests look with: commands as a user types them, terminals, browsers, slow oracles."""
