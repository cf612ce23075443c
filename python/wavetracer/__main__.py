"""`python -m wavetracer` is the command `wavetracer`."""
from ._program import main

main()
