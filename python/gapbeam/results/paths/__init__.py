"""The loading history: from event to event, past limits, on smooth laws and on the ground."""
