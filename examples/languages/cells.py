"""Are the cells of a tissue hexagons? The same story in Python, Fortran, R and Julia, with the same output.

    make shared
    SURFMINK_LIBRARY=.build/libsurfmink.so python3 examples/languages/cells.py examples/data/tissue.tsv
"""
import sys

import numpy as np

import surfmink

# One corner a line: the cell it belongs to, where it is, and the outer normal of the tissue there.
table = np.loadtxt(sys.argv[1], skiprows=4)
corner, normal = table[:, 1:4].copy(), table[:, 4:7].copy()
offset = surfmink.offsets(table[:, 0])

cells = surfmink.embedded(corner, normal, offset)
cells.check()  # is every one of them measured?
print("%d cells, %d corners" % (len(cells.L), len(corner)))

# mu_6 is 1 for a cell with six equal angles, mu_5 for one with five.
corners = np.diff(offset)
for n in range(4, 10):
    those = corners == n
    print("%d corners: %3d cells, mean mu_5 %.4f, mean mu_6 %.4f" % (
        n, those.sum(), cells.mu[those, 5].mean(), cells.mu[those, 6].mean()))

# mu_2 is elongation. theta says where: from the outer co-normal of the first edge towards that edge.
longest = cells.mu[:, 2].argmax()
print("cell %d is the most elongated: mu_2 %.4f, theta_2 %.4f" % (
    table[offset[longest], 0], cells.mu[longest, 2], cells.theta[longest, 2]))
