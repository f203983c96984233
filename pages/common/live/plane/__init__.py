"""The instrument of the plane of Kc and tau_I: a point that is dragged, with the responses beside it."""
