"""The accuracy page: published numbers beside ours."""
