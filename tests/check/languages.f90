! Holds examples/languages/surfmink.f90 to surfmink.h: each interface is called, with known answers.
module surfaces
    use, intrinsic :: iso_c_binding
    use surfmink
    implicit none

contains

    integer(c_int) function plane_log(context, x, y, length, direction) bind(c)
        type(c_ptr), value :: context
        real(c_double), intent(in) :: x(*), y(*)
        real(c_double), intent(out) :: length, direction(2)
        plane_log = surfmink_ok
        if (c_associated(context) .or. y(1) > 99) plane_log = surfmink_callback_failed
        direction = y(1:2) - x(1:2)
        length = norm2(direction)
    end function
end module

program languages
    use, intrinsic :: iso_c_binding
    use surfmink
    use surfaces
    implicit none
    integer, parameter :: p = 6
    real(c_double), parameter :: pi = acos(-1.0_c_double)
    real(c_double) :: square(2, 4) = reshape([0, 0, 1, 0, 1, 1, 0, 1], [2, 4])
    real(c_double) :: octant(3, 3) = reshape([0, 0, 1, 1, 0, 0, 0, 1, 0], [3, 3])
    real(c_double) :: two(2, 8), space(3, 7), mu(0:p), g(2, 0:p), theta(0:p), lambda(0:p), scratch(16)
    real(c_double), target :: mus(0:p, 2), gs(2, 0:p, 2), thetas(0:p, 2), length(2), turning(2), area(2)
    integer(c_size_t), target :: bad(2)
    integer(c_int), target :: status(2)
    integer(c_size_t) :: corner_to_blame
    type(surfmink_functionals) :: w
    type(surfmink_results) :: out
    type(surfmink_surface) :: plane
    integer :: passed = 0, failed = 0, said

    call check('measure_plane', surfmink_measure_plane(square, 4_c_size_t, p, mu, g, w, corner_to_blame) == 0)
    call near('mu of a square', mu, real([1, 0, 0, 0, 1, 0, 0], c_double))
    call near('its functionals', [w%area, w%length, w%turning, w%curvature, w%condition], &
        [1.0_c_double, 4.0_c_double, 2 * pi, 0.0_c_double, 1.0_c_double])
    call check('without mu', surfmink_measure_plane(square, 4_c_size_t, p, g=g) == 0)
    call check('spectrum', surfmink_spectrum(g, p, lambda, theta=theta) == 0)
    call near('lambda_4 and theta_4', [lambda(4), theta(4)], [4.0_c_double, 0.0_c_double])
    call check('measure_sphere', &
        surfmink_measure_sphere(octant, 3_c_size_t, 2.0_c_double, p, mu, w=w) == surfmink_ok)
    call near('mu of an octant', mu, real([1, 0, 0, 1, 0, 0, 1], c_double))
    call near('its area', [w%area], [2 * pi])
    call check('measure_embedded', surfmink_measure_embedded(octant, octant, 3_c_size_t, p, mu) == surfmink_ok)
    call near('mu of its chords', mu, real([1, 0, 0, 1, 0, 0, 1], c_double))
    corner_to_blame = 77
    said = surfmink_measure_plane(square(:, 4:1:-1), 4_c_size_t, p, bad=corner_to_blame)
    call check('a refusal', said == surfmink_clockwise .and. corner_to_blame == 4)
    call check('its name', surfmink_status_name(said) == 'clockwise')
    call check('the last name', surfmink_status_name(surfmink_bad_argument) == 'bad_argument')
    call check('its sentence', index(surfmink_strerror(said), 'clockwise') > 0)
    said = surfmink_from_lonlat(90.0_c_double, 0.0_c_double, 2.0_c_double, octant(:, 1))
    call near('from_lonlat', octant(:, 1), real([0, 2, 0], c_double))
    octant(:, 1) = [0, 0, 1]

    out = surfmink_results(c_loc(status), c_loc(bad), c_loc(length), c_loc(turning), c_loc(area), c_loc(mus), &
        c_loc(gs), c_loc(thetas))
    two(:, 1:4) = square
    two(:, 5:8) = square(:, 4:1:-1)
    mus = -7
    call check('batch_plane', surfmink_batch_plane(two, [0_c_size_t, 4_c_size_t, 8_c_size_t], 2_c_size_t, p, out) == 1)
    call check('its statuses', all(status == [surfmink_ok, surfmink_clockwise]) .and. bad(2) == 4)
    call near('its mu', mus(:, 1), real([1, 0, 0, 0, 1, 0, 0], c_double))
    call check('nothing of the refused', all(abs(mus(:, 2) + 7) < 0.1))
    call near('its L, S, area, g_4, theta_4', [length(1), turning(1), area(1), gs(:, 4, 1), thetas(4, 1)], &
        [4.0_c_double, 2 * pi, 1.0_c_double, 4.0_c_double, 0.0_c_double, 0.0_c_double])
    space(:, 1:3) = octant
    space(:, 4) = [1, 1, 3]
    space(:, 5) = [-1, 1, 3]
    space(:, 6) = [-1, -1, 3]
    space(:, 7) = [1, -1, 3]
    call check('batch_sphere', surfmink_batch_sphere(space, [0_c_size_t, 3_c_size_t, 7_c_size_t], 2_c_size_t, &
        2.0_c_double, p, out, scratch) == 0)
    call near('its mu', [mus(3, 1), mus(4, 2)], [1.0_c_double, 1.0_c_double])
    call near('its area', area(1:1), [2 * pi])
    call check('batch_embedded', surfmink_batch_embedded(space, space, [0_c_size_t, 3_c_size_t, 7_c_size_t], &
        2_c_size_t, p, out, scratch) == 0)
    call near('its mu', [mus(6, 1), mus(4, 2)], [1.0_c_double, 1.0_c_double])
    call near('its L', length, [3 * sqrt(2.0_c_double), 8.0_c_double])

    plane%stride = 2
    plane%log = c_funloc(plane_log)
    call check('measure_surface', surfmink_measure_surface(plane, square, 4_c_size_t, scratch, p, mu) == surfmink_ok)
    call near('mu by callback', mu, real([1, 0, 0, 0, 1, 0, 0], c_double))
    square(1, 2) = 100
    call check('a callback that fails', surfmink_measure_surface(plane, square, 4_c_size_t, scratch, p) == &
        surfmink_callback_failed)
    print '(i0, a, i0, a)', passed, ' passed, ', failed, ' failed'
    if (failed > 0) error stop

contains

    subroutine check(name, holds)
        character(*), intent(in) :: name
        logical, intent(in) :: holds
        if (holds) then
            passed = passed + 1
        else
            failed = failed + 1
            print '(2a)', 'FAILED ', name
        end if
    end subroutine

    subroutine near(name, got, want)
        character(*), intent(in) :: name
        real(c_double), intent(in) :: got(:), want(:)
        call check(name, all(abs(got - want) <= 1e-14_c_double * max(1.0_c_double, abs(want))))
    end subroutine
end program
