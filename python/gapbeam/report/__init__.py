"""Results as text, for people and for programs."""

from .text import print_report, report_text, to_csv, to_json

__all__ = ["print_report", "report_text", "to_csv", "to_json"]
