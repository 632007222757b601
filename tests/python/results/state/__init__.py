"""States: values, contact, certificates, with and without ground."""
