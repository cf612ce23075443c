# SPDX-License-Identifier: Apache-2.0
"""`python -m wavetracer` is the command `wavetracer`."""
from ._program import main

main()
