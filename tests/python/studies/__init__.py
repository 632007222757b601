"""The study of accuracy, its true values and yardsticks."""
