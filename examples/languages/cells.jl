# Are the cells of a tissue hexagons? The same story in Python, Fortran, R and Julia, with the same output.
#
#   make shared
#   SURFMINK_LIBRARY=.build/libsurfmink.so julia examples/languages/cells.jl examples/data/tissue.tsv
using DelimitedFiles, Printf

const library = get(ENV, "SURFMINK_LIBRARY", "libsurfmink")

strerror(status) = unsafe_string(ccall((:surfmink_flat_strerror, library), Cstring, (Cint,), status))

# flat.h says what the arguments are. corner and normal 3 x n: columns lie one after the other in memory, as C wants them. Offsets count from 0.
function embedded(corner::Matrix{Float64}, normal::Matrix{Float64}, offset::Vector{Csize_t}, max_rank)
    count = length(offset) - 1
    size(corner, 1) == 3 && size(corner) == size(normal) && all(offset .<= size(corner, 2)) ||
        error("corner and normal are 3 x n, and no offset is above n")
    mu, theta = fill(NaN, max_rank + 1, count), fill(NaN, max_rank + 1, count)
    status = zeros(Cint, count)
    # kind 2 is embedded; C_NULL for what is not asked for: bad, length, turning, area, g, scratch
    ccall((:surfmink_flat_batch, library), Csize_t,
        (Cint, Ptr{Cdouble}, Ptr{Cdouble}, Csize_t, Cdouble, Ptr{Csize_t}, Csize_t, Cint, Ptr{Cint}, Ptr{Csize_t},
            Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}),
        2, corner, normal, size(corner, 2), 1.0, offset, count, max_rank, status, C_NULL,
        C_NULL, C_NULL, C_NULL, mu, C_NULL, theta, C_NULL)
    return mu, theta, status
end

# One corner a line: the cell it belongs to, where it is, and the outer normal of the tissue there.
table = readdlm(ARGS[1], '\t', Float64; skipstart = 4)
id = table[:, 1]
first_rows = [1; findall(id[2:end] .!= id[1:end-1]) .+ 1]
offset = Csize_t[first_rows .- 1; length(id)]
mu, theta, status = embedded(permutedims(table[:, 2:4]), permutedims(table[:, 5:7]), offset, 6)
for i in findall(status .!= 0)
    error("cell $(Int(id[first_rows[i]])): $(strerror(status[i]))")
end
@printf("%d cells, %d corners\n", length(status), length(id))

# mu_6 is 1 for a cell with six equal angles, mu_5 for one with five.
for n in 4:9
    those = findall(diff(Int.(offset)) .== n)
    @printf("%d corners: %3d cells, mean mu_5 %.4f, mean mu_6 %.4f\n", n, length(those),
        sum(mu[6, those]) / length(those), sum(mu[7, those]) / length(those))
end

# mu_2 is elongation. theta says where: from the outer co-normal of the first edge towards that edge.
longest = argmax(mu[3, :])
@printf("cell %d is the most elongated: mu_2 %.4f, theta_2 %.4f\n", id[first_rows[longest]], mu[3, longest],
    theta[3, longest])
