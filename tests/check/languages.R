# languages.R LIBRARY: holds examples/languages/surfmink_r.c to what it says.
dyn.load(commandArgs(trailingOnly = TRUE)[1])
batch <- function(corner, offset, normal = NULL, radius = NULL, max_rank = 6L)
    .Call("surfmink_r_batch", corner, normal, radius, offset, max_rank)
passed <- 0
failed <- 0
check <- function(name, holds) {
    if (isTRUE(holds)) passed <<- passed + 1
    else {
        failed <<- failed + 1
        cat("FAILED", name, "\n")
    }
}
near <- function(got, want) length(got) == length(want) && all(abs(got - want) < 1e-14)
refused <- function(words, call) {
    said <- tryCatch({ call; "nothing" }, error = conditionMessage)
    check(paste("refused:", words), grepl(words, said, fixed = TRUE))
}

square <- matrix(c(0, 0, 1, 0, 1, 1, 0, 1), 2)
octant <- matrix(c(0, 0, 1, 1, 0, 0, 0, 1, 0), 3)
two <- batch(cbind(square, square[, 4:1]), c(0, 4, 8))
check("the mu of a square", near(two$mu[, 1], c(1, 0, 0, 0, 1, 0, 0)))
check("its L, S, area, theta_4", near(c(two$L[1], two$S[1], two$area[1], two$theta[5, 1]), c(4, 2 * pi, 1, 0)))
check("another is refused by name", identical(.Call("surfmink_r_status_name", two$status), c("ok", "clockwise")))
check("and has no numbers", all(is.na(c(two$mu[, 2], two$theta[, 2], two$L[2], two$S[2], two$area[2]))))
sphere <- batch(octant, c(0, 3), radius = 2)
check("the mu of an octant", near(sphere$mu[, 1], c(1, 0, 0, 1, 0, 0, 1)))
check("its L, S, area", near(c(sphere$L, sphere$S, sphere$area), c(3 * pi, 1.5 * pi, 2 * pi)))
check("its chords", near(batch(octant, c(0, 3), octant, max_rank = 3L)$mu[, 1], c(1, 0, 0, 1)))
check("no outlines", identical(dim(batch(square, 0)$mu), c(7L, 0L)))
refused("offset[2]", batch(square, c(0, 5)))
refused("offset[1]", batch(square, c(-1, 4)))
refused("offset[2]", batch(square, c(0, NA)))
refused("offset", batch(square, c(0L, 4L)))
refused("corner is no matrix", batch(c(square), c(0, 4)))
refused("corner has 4 rows", batch(t(square), c(0, 2)))
refused("give normal, or radius", batch(octant, c(0, 3)))
refused("normal", batch(octant, c(0, 3), square))
refused("max_rank", batch(square, c(0, 4), max_rank = -1L))
refused("max_rank", batch(square, c(0, 4), max_rank = NA))
cat(passed, "passed,", failed, "failed\n")
