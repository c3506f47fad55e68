"""What a subset must keep to beside its force: one condition per file, over rows of regions and single subsets."""
