"""Views that all results share: values by name, tables, pictures, texts."""
