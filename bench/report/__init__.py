"""Turns a results directory of the Koksma program into one self-contained report.html.

The statistics are computed by the program and handed over in summary.json; this package reads,
draws and lays out. It needs matplotlib, numpy and jinja2, and nothing from the network.

    python3 -m report DIR
"""
