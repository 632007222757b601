"""The way of the load: from event to event, past limits, on smooth laws and on the ground."""
