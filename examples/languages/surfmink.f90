! surfmink from Fortran: the interfaces of examples/languages/flat.h, which says what the arguments are, under shorter
! names; not that of the field of a tissue.
!
!   make shared
!   gfortran examples/languages/surfmink.f90 examples/languages/cells.f90 -L.build -lsurfmink -Wl,-rpath,.build
!
! Corners are corner(2, n) or corner(3, n): in memory they lie one after the other, as C wants them. Offsets, edges and
! corners to blame count from 0, as in C: outline i has the corners offset(i) + 1 ... offset(i + 1). What is optional is
! left out or named: surfmink_measure(surfmink_plane, corner, n=4_c_size_t, radius=1.0_c_double, max_rank=6, mu=mu).
module surfmink
    use, intrinsic :: iso_c_binding, only: c_int, c_size_t, c_double, c_signed_char, c_ptr, c_funptr, c_char, &
        c_null_ptr, c_null_funptr, c_f_pointer, c_associated
    implicit none

    enum, bind(c) ! surfmink_status
        enumerator :: surfmink_ok = 0, surfmink_too_few_corners, surfmink_not_finite, surfmink_coincident_corners, &
            surfmink_zero_normal, surfmink_upright_edge, surfmink_antipodal_corners, surfmink_clockwise, &
            surfmink_too_much_curvature, surfmink_crosses_itself, surfmink_callback_failed, surfmink_bad_argument, &
            surfmink_opposite_normals, surfmink_curve_unlike_edges = 100
    end enum

    enum, bind(c) ! surfmink_transport
        enumerator :: surfmink_corrected = 0, surfmink_parallel, surfmink_defect
    end enum

    enum, bind(c) ! surfmink_kind
        enumerator :: surfmink_plane = 0, surfmink_sphere, surfmink_embedded
    end enum

    ! The callbacks are c_funloc of functions with bind(c) and these interfaces: surfmink_log, surfmink_exp.
    type, bind(c) :: surfmink_surface
        type(c_ptr) :: context = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_funptr) :: log = c_null_funptr
        type(c_funptr) :: exp = c_null_funptr
    end type

    abstract interface
        integer(c_int) function surfmink_log(context, x, y, length, direction) bind(c)
            import :: c_int, c_ptr, c_double
            type(c_ptr), value :: context
            real(c_double), intent(in) :: x(*), y(*)
            real(c_double), intent(out) :: length, direction(2)
        end function

        integer(c_int) function surfmink_exp(context, x, direction, length, y) bind(c)
            import :: c_int, c_ptr, c_double
            type(c_ptr), value :: context
            real(c_double), intent(in) :: x(*), direction(2)
            real(c_double), value :: length
            real(c_double), intent(out) :: y(*)
        end function
    end interface

    interface
        ! w: area, length, turning, curvature, condition
        integer(c_int) function surfmink_measure(kind, corner, normal, n, radius, max_rank, mu, g, w, bad) &
            bind(c, name="surfmink_flat_measure")
            import :: c_int, c_size_t, c_double
            integer(c_int), value :: kind
            real(c_double), intent(in) :: corner(*)
            real(c_double), intent(in), optional :: normal(3, *)
            integer(c_size_t), value :: n
            real(c_double), value :: radius
            integer(c_int), value :: max_rank
            real(c_double), intent(inout), optional :: mu(0:*), g(2, 0:*), w(5)
            integer(c_size_t), intent(inout), optional :: bad
        end function

        integer(c_int) function surfmink_measure_surface(surface, corner, n, max_rank, mu, g, w, bad) &
            bind(c, name="surfmink_flat_measure_surface")
            import :: c_int, c_size_t, c_double, surfmink_surface
            type(surfmink_surface), intent(in) :: surface
            real(c_double), intent(in) :: corner(*)
            integer(c_size_t), value :: n
            integer(c_int), value :: max_rank
            real(c_double), intent(inout), optional :: mu(0:*), g(2, 0:*), w(5)
            integer(c_size_t), intent(inout), optional :: bad
        end function

        ! mu, theta (0:P, count), g (2, 0:P, count)
        integer(c_size_t) function surfmink_batch(kind, corner, normal, n, radius, offset, count, max_rank, status, &
            bad, length, turning, area, mu, g, theta, scratch) bind(c, name="surfmink_flat_batch")
            import :: c_int, c_size_t, c_double
            integer(c_int), value :: kind
            real(c_double), intent(in) :: corner(*)
            real(c_double), intent(in), optional :: normal(3, *)
            integer(c_size_t), value :: n
            real(c_double), value :: radius
            integer(c_size_t), intent(in) :: offset(*)
            integer(c_size_t), value :: count
            integer(c_int), value :: max_rank
            integer(c_int), intent(inout), optional :: status(*)
            integer(c_size_t), intent(inout), optional :: bad(*)
            real(c_double), intent(inout), optional :: length(*), turning(*), area(*), mu(*), g(*), theta(*), scratch(*)
        end function

        integer(c_int) function surfmink_curve(kind, corner, normal, n, radius, order, sharp, max_rank, mu, error, &
            g, w, scratch, bad) bind(c, name="surfmink_flat_curve")
            import :: c_int, c_size_t, c_double, c_signed_char
            integer(c_int), value :: kind
            real(c_double), intent(in) :: corner(*)
            real(c_double), intent(in), optional :: normal(3, *)
            integer(c_size_t), value :: n
            real(c_double), value :: radius
            integer(c_int), value :: order
            integer(c_signed_char), intent(in), optional :: sharp(*)
            integer(c_int), value :: max_rank
            real(c_double), intent(inout), optional :: mu(0:*), error(0:*), g(2, 0:*), w(5)
            real(c_double), intent(inout) :: scratch(*)
            integer(c_size_t), intent(inout), optional :: bad
        end function

        integer(c_size_t) function surfmink_gradient(kind, corner, normal, n, radius, offset, count, max_rank, by_mu, &
            by_g, by_theta, by_length, shared, status, bad, mu, g, theta, w, by_corner, by_normal, scratch) &
            bind(c, name="surfmink_flat_gradient")
            import :: c_int, c_size_t, c_double
            integer(c_int), value :: kind
            real(c_double), intent(in) :: corner(*)
            real(c_double), intent(in), optional :: normal(3, *)
            integer(c_size_t), value :: n
            real(c_double), value :: radius
            integer(c_size_t), intent(in) :: offset(*)
            integer(c_size_t), value :: count
            integer(c_int), value :: max_rank
            real(c_double), intent(in), optional :: by_mu(*), by_g(*), by_theta(*), by_length(*)
            integer(c_int), value :: shared
            integer(c_int), intent(inout), optional :: status(*)
            integer(c_size_t), intent(inout), optional :: bad(*)
            real(c_double), intent(inout), optional :: mu(*), g(*), theta(*), w(5, *)
            real(c_double), intent(inout) :: by_corner(*)
            real(c_double), intent(inout), optional :: by_normal(3, *)
            real(c_double), intent(inout) :: scratch(*)
        end function

        integer(c_int) function surfmink_director(kind, corner, normal, n, radius, max_rank, mu, g, w, centre, &
            mean_normal, direction, coherence, scratch, bad) bind(c, name="surfmink_flat_director")
            import :: c_int, c_size_t, c_double
            integer(c_int), value :: kind
            real(c_double), intent(in) :: corner(*)
            real(c_double), intent(in), optional :: normal(3, *)
            integer(c_size_t), value :: n
            real(c_double), value :: radius
            integer(c_int), value :: max_rank
            real(c_double), intent(inout), optional :: mu(0:*), g(2, 0:*), w(5), centre(3), mean_normal(3), &
                direction(*), coherence(0:*)
            real(c_double), intent(inout) :: scratch(*)
            integer(c_size_t), intent(inout), optional :: bad
        end function

        integer(c_int) function surfmink_spectrum(g, max_rank, lambda, mu, theta) bind(c)
            import :: c_int, c_double
            real(c_double), intent(in) :: g(2, 0:*)
            integer(c_int), value :: max_rank
            real(c_double), intent(inout), optional :: lambda(0:*), mu(0:*), theta(0:*)
        end function

        integer(c_int) function surfmink_from_lonlat(lon, lat, radius, point) bind(c)
            import :: c_int, c_double
            real(c_double), value :: lon, lat, radius
            real(c_double), intent(inout) :: point(3)
        end function

        type(c_ptr) function surfmink_strerror_c(status) bind(c, name="surfmink_flat_strerror")
            import :: c_int, c_ptr
            integer(c_int), value :: status
        end function

        type(c_ptr) function surfmink_status_name_c(status) bind(c, name="surfmink_flat_status_name")
            import :: c_int, c_ptr
            integer(c_int), value :: status
        end function
    end interface

contains

    ! What is wrong, in a sentence.
    function surfmink_strerror(status) result(text)
        integer(c_int), intent(in) :: status
        character(len=:), allocatable :: text
        text = from_c(surfmink_strerror_c(status))
    end function

    ! What is wrong, in a word.
    function surfmink_status_name(status) result(text)
        integer(c_int), intent(in) :: status
        character(len=:), allocatable :: text
        text = from_c(surfmink_status_name_c(status))
    end function

    ! A C string, which ends with a zero.
    function from_c(address) result(text)
        type(c_ptr), intent(in) :: address
        character(len=:), allocatable :: text
        character(kind=c_char), pointer :: letter(:)
        integer :: i, n
        call c_f_pointer(address, letter, [1000])
        n = 0
        do while (letter(n + 1) /= char(0))
            n = n + 1
        end do
        allocate (character(len=n) :: text)
        do i = 1, n
            text(i:i) = letter(i)
        end do
    end function
end module
