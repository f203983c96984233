"""What both instruments are made of: panels, sliders, the strip, tables in the browser, packing."""
