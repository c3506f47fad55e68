"""What a real hand can use: which candidates a finger may touch, and what any two of them must keep to."""
