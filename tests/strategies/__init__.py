"""What tests are made of: one generator per noun."""
