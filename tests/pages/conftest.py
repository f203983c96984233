"""Settings of the tests of pages."""

from functools import cache

from streamlit.components.v2 import manifest_scanner

# For each AppTest Streamlit reads what every installed package says of itself, to find components among them. It is the
# same each time, and takes as long as a run of a page.
manifest_scanner.scan_component_manifests = cache(manifest_scanner.scan_component_manifests)
