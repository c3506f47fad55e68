"""Does a grasp belong to its object: mass, task and candidates made again, and compared?"""
