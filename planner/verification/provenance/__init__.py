"""Does a grasp belong to its object, its task and its candidates? They are made again and compared."""
