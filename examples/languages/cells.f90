! Are the cells of a tissue hexagons? The same story in Python, Fortran, R and Julia, with the same output.
!
!   make shared
!   gfortran examples/languages/surfmink.f90 examples/languages/cells.f90 -L.build -lsurfmink -Wl,-rpath,.build
!   ./a.out examples/data/tissue.tsv
program cells
    use, intrinsic :: iso_c_binding, only: c_int, c_size_t, c_double
    use surfmink
    implicit none
    integer, parameter :: most = 100000, p = 6
    real(c_double) :: corner(3, most), normal(3, most), row(7)
    integer(c_size_t) :: offset(most + 1)
    integer :: id(most)
    real(c_double), allocatable :: mu(:, :), theta(:, :)
    integer(c_int), allocatable :: status(:)
    character(len=1000) :: line, table
    integer(c_size_t) :: count, n, refused
    integer :: i, end, file
    logical, allocatable :: those(:)

    ! One corner a line: the cell it belongs to, where it is, and the outer normal of the tissue there.
    call get_command_argument(1, table)
    open (newunit=file, file=trim(table), status='old', action='read')
    n = 0
    count = 0
    do
        read (file, '(a)', iostat=end) line
        if (end /= 0) exit
        if (line(1:1) == '#' .or. line(1:4) == 'cell') cycle
        read (line, *) row
        if (n == most) stop 'too many corners'
        if (count == 0 .or. id(max(count, 1_c_size_t)) /= nint(row(1))) then
            count = count + 1
            offset(count) = n
            id(count) = nint(row(1))
        end if
        n = n + 1
        corner(:, n) = row(2:4)
        normal(:, n) = row(5:7)
    end do
    close (file)
    offset(count + 1) = n

    allocate (mu(0:p, count), theta(0:p, count), status(count))
    refused = surfmink_batch(surfmink_embedded, corner, normal, n, 1.0_c_double, offset, count, p, status, mu=mu, &
        theta=theta)
    do i = 1, int(count)
        if (status(i) /= surfmink_ok) print '(a, i0, a)', 'cell ', id(i), ': '//surfmink_strerror(status(i))
    end do
    if (refused > 0) error stop
    print '(i0, a, i0, a)', count, ' cells, ', n, ' corners'

    ! mu_6 is 1 for a cell with six equal angles, mu_5 for one with five.
    do i = 4, 9
        those = offset(2:count + 1) - offset(1:count) == i
        print '(i0, a, i3, a, f6.4, a, f6.4)', i, ' corners: ', count_of(those), ' cells, mean mu_5 ', &
            sum(mu(5, :), those) / count_of(those), ', mean mu_6 ', sum(mu(6, :), those) / count_of(those)
    end do

    ! mu_2 is elongation. theta says where: from the outer co-normal of the first edge towards that edge.
    i = maxloc(mu(2, :), 1)
    print '(a, i0, a, f6.4, a, f7.4)', 'cell ', id(i), ' is the most elongated: mu_2 ', mu(2, i), ', theta_2 ', &
        theta(2, i)

contains

    integer function count_of(mask)
        logical, intent(in) :: mask(:)
        count_of = int(size(pack(mask, mask)))
    end function
end program
