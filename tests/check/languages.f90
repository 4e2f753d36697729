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
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use surfmink
    use surfaces
    implicit none
    integer, parameter :: p = 6
    real(c_double), parameter :: pi = acos(-1.0_c_double)
    real(c_double) :: square(2, 4) = reshape([0, 0, 1, 0, 1, 1, 0, 1], [2, 4])
    real(c_double) :: octant(3, 3) = reshape([0, 0, 1, 1, 0, 0, 0, 1, 0], [3, 3])
    real(c_double), parameter :: unit = 1
    real(c_double) :: two(2, 8), space(3, 7), mu(0:p), g(2, 0:p), theta(0:p), lambda(0:p), scratch(200), w(5)
    real(c_double) :: mus(0:p, 2), gs(2, 0:p, 2), thetas(0:p, 2), length(2), turning(2), area(2), error(0:p)
    real(c_double) :: by_mu(0:p), by_corner(2, 4), by_space(3, 3), by_normal(3, 3), centre(3), normal(3)
    real(c_double) :: direction(3, 0:p), coherence(0:p)
    integer(c_size_t) :: bad(2)
    integer(c_int) :: status(2)
    integer(c_size_t), parameter :: three = 3, four = 4
    integer(c_size_t) :: corner_to_blame
    type(surfmink_surface) :: plane
    integer :: passed = 0, failed = 0, said

    call check('measure, plane', surfmink_measure(surfmink_plane, square, n=four, radius=unit, max_rank=p, mu=mu, g=g, &
        w=w, bad=corner_to_blame) == 0)
    call near('mu of a square', mu, real([1, 0, 0, 0, 1, 0, 0], c_double))
    call near('its functionals', w, [1.0_c_double, 4.0_c_double, 2 * pi, 0.0_c_double, 1.0_c_double])
    call check('without mu', surfmink_measure(surfmink_plane, square, n=four, radius=unit, max_rank=p, g=g) == 0)
    call check('spectrum', surfmink_spectrum(g, p, lambda, theta=theta) == 0)
    call near('lambda_4 and theta_4', [lambda(4), theta(4)], [4.0_c_double, 0.0_c_double])
    call check('measure, sphere', surfmink_measure(surfmink_sphere, octant, n=three, radius=2 * unit, max_rank=p, &
        mu=mu, w=w) == surfmink_ok)
    call near('mu of an octant', mu, real([1, 0, 0, 1, 0, 0, 1], c_double))
    call near('its area', w(1:1), [2 * pi])
    call check('measure, embedded', &
        surfmink_measure(surfmink_embedded, octant, octant, three, unit, p, mu) == surfmink_ok)
    call near('mu of its chords', mu, real([1, 0, 0, 1, 0, 0, 1], c_double))
    call check('a kind that is none', surfmink_measure(7, octant, octant, three, unit, p, mu) == surfmink_bad_argument)
    corner_to_blame = 77
    said = surfmink_measure(surfmink_plane, square(:, 4:1:-1), n=four, radius=unit, max_rank=p, bad=corner_to_blame)
    call check('a refusal', said == surfmink_clockwise .and. corner_to_blame == 4)
    call check('its name', surfmink_status_name(said) == 'clockwise')
    call check('the last names', surfmink_status_name(surfmink_opposite_normals) == 'opposite_normals' .and. &
        surfmink_status_name(surfmink_curve_unlike_edges) == 'unlike_edges')
    call check('its sentence', index(surfmink_strerror(said), 'clockwise') > 0)
    said = surfmink_from_lonlat(90.0_c_double, 0.0_c_double, 2.0_c_double, octant(:, 1))
    call near('from_lonlat', octant(:, 1), real([0, 2, 0], c_double))
    octant(:, 1) = [0, 0, 1]

    two(:, 1:4) = square
    two(:, 5:8) = square(:, 4:1:-1)
    mus = -7
    call check('batch, plane', surfmink_batch(surfmink_plane, two, n=2 * four, radius=unit, &
        offset=[0_c_size_t, 4_c_size_t, 8_c_size_t], count=2_c_size_t, max_rank=p, status=status, bad=bad, &
        length=length, turning=turning, area=area, mu=mus, g=gs, theta=thetas) == 1)
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
    call check('batch, sphere', surfmink_batch(surfmink_sphere, space, n=7_c_size_t, radius=2 * unit, &
        offset=[0_c_size_t, 3_c_size_t, 7_c_size_t], count=2_c_size_t, max_rank=p, area=area, mu=mus, &
        scratch=scratch) == 0)
    call near('its mu', [mus(3, 1), mus(4, 2)], [1.0_c_double, 1.0_c_double])
    call near('its area', area(1:1), [2 * pi])
    call check('batch, embedded', surfmink_batch(surfmink_embedded, space, space, 7_c_size_t, unit, &
        [0_c_size_t, 3_c_size_t, 7_c_size_t], 2_c_size_t, p, length=length, mu=mus) == 0)
    call near('its mu', [mus(6, 1), mus(4, 2)], [1.0_c_double, 1.0_c_double])
    call near('its L', length, [3 * sqrt(2.0_c_double), 8.0_c_double])

    plane%stride = 2
    plane%log = c_funloc(plane_log)
    call check('measure_surface', surfmink_measure_surface(plane, square, four, p, mu, w=w) == surfmink_ok)
    call near('mu by callback', mu, real([1, 0, 0, 0, 1, 0, 0], c_double))
    call near('its L', w(2:2), [4.0_c_double])
    call check('its area is not known', ieee_is_nan(w(1)))

    call check('curve', surfmink_curve(surfmink_plane, square, n=four, radius=unit, order=4, &
        sharp=[1_c_signed_char, 1_c_signed_char, 1_c_signed_char, 1_c_signed_char], max_rank=p, mu=mu, error=error, &
        w=w, scratch=scratch) == surfmink_ok)
    call near('a curve with sharp corners', [mu, w(2)], real([1, 0, 0, 0, 1, 0, 0, 4], c_double))
    by_mu = 0
    call check('gradient', surfmink_gradient(surfmink_plane, square, n=four, radius=unit, &
        offset=[0_c_size_t, 4_c_size_t], count=1_c_size_t, max_rank=p, by_mu=by_mu, by_length=[1.0_c_double], &
        shared=1, status=status, mu=mu, by_corner=by_corner, scratch=scratch) == 0)
    call near('the gradient of L', reshape(by_corner, [8]), real([-1, -1, 1, -1, 1, 1, -1, 1], c_double))
    call check('gradient, embedded', surfmink_gradient(surfmink_embedded, octant, octant, three, unit, &
        [0_c_size_t, 3_c_size_t], 1_c_size_t, p, by_length=[1.0_c_double], shared=0, by_corner=by_space, &
        by_normal=by_normal, scratch=scratch) == 0)
    call near('of L by normals', reshape(by_normal, [9]), spread(0.0_c_double, 1, 9))
    call check('director', surfmink_director(surfmink_sphere, octant, n=three, radius=2 * unit, max_rank=p, mu=mu, &
        centre=centre, mean_normal=normal, direction=direction, coherence=coherence, scratch=scratch) == surfmink_ok)
    call near('the centre of an octant', centre, 2 * spread(1 / sqrt(3.0_c_double), 1, 3))
    call near('its normal and coherence', [normal, coherence(3)], &
        [spread(1 / sqrt(3.0_c_double), 1, 3), 1.0_c_double])
    call near('a direction in the surface', [dot_product(direction(:, 3), normal), norm2(direction(:, 3))], &
        [0.0_c_double, 1.0_c_double])

    square(1, 2) = 100
    call check('a callback that fails', surfmink_measure_surface(plane, square, four, p) == surfmink_callback_failed)
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
