# Are the cells of a tissue hexagons? The same story in Python, Fortran, R and Julia, with the same output.
#
#   R CMD SHLIB examples/languages/surfmink_r.c
#   Rscript examples/languages/cells.R examples/languages/surfmink_r.so examples/data/tissue.tsv
argument <- commandArgs(trailingOnly = TRUE)
dyn.load(argument[1])

# corner 2 x n or 3 x n, each column a corner; offset counts from 0. Outlines of the plane, or with normals (3 x n) of
# any surface, or with a radius of a sphere. Numbers of refused outlines are NA; status is a word.
measure <- function(corner, offset, normal = NULL, radius = NULL, max_rank = 6) {
    out <- .Call("surfmink_r_batch", corner, normal, radius, as.double(offset), as.integer(max_rank))
    out$status <- .Call("surfmink_r_status_name", out$status)
    out
}

# One corner a line: the cell it belongs to, where it is, and the outer normal of the tissue there.
table <- read.table(argument[2], header = TRUE)
corner <- t(as.matrix(table[, c("x", "y", "z")]))
normal <- t(as.matrix(table[, c("nx", "ny", "nz")]))
first <- c(1, which(diff(table$cell) != 0) + 1)
offset <- c(first - 1, nrow(table))
cells <- measure(corner, offset, normal)
stopifnot(cells$status == "ok")
cat(sprintf("%d cells, %d corners\n", length(cells$status), nrow(table)))

# mu_6 is 1 for a cell with six equal angles, mu_5 for one with five.
for (n in 4:9) {
    those <- diff(offset) == n
    cat(sprintf("%d corners: %3d cells, mean mu_5 %.4f, mean mu_6 %.4f\n", n, sum(those),
                mean(cells$mu[6, those]), mean(cells$mu[7, those])))
}

# mu_2 is elongation. theta says where: from the outer co-normal of the first edge towards that edge.
longest <- which.max(cells$mu[3, ])
cat(sprintf("cell %d is the most elongated: mu_2 %.4f, theta_2 %.4f\n", table$cell[first[longest]],
            cells$mu[3, longest], cells$theta[3, longest]))
