! The yardsticks of the studies for Python: plain arrays only, as f2py reads this very file.

! Solve one beam of N elements by one method
subroutine ysbeam(method, refine, precis, react, n, length, ei, q, side, stiff, level, force, clampl, clampr, &
                  repeat, w, m, r, closed, solves, status)
    use yardstick_beam, only: beam_type, answer_type, find_contact_state
    use yardstick_mixed, only: mixed_type
    use yardstick_displacement, only: displacement_type
    use yardstick_condensed, only: solve_condensed
    implicit none
    ! METHOD: 0 nodal mixed by the engine's elimination, 1 nodal mixed by dgbsv, 2 displacement, 3 displacement, incremental,
    ! 4 condensed mixed, the engine's normal route
    ! REFINE: steps of refinement of the mixed ones; PRECIS: 1 with residuals in double-double, 0 plain, differences first
    ! REACT: 0 leaves out the reactions of the mixed ones, which two-sided supports allow
    integer, intent(in) :: method, refine, precis, react
    ! Elements: length, EI, uniform load (down)
    integer, intent(in) :: n
    double precision, intent(in), target :: length(n), ei(n), q(n)
    ! Nodes: side of the support (1 pushes up only, -1 down only, 0 both), its stiffness (0 none, infinite rigid), deflection of
    ! first contact; force (down); CLAMPL, CLAMPR: 1 where the rotation of the first, last node is held
    integer, intent(in), target :: side(0:n)
    double precision, intent(in), target :: stiff(0:n), level(0:n), force(0:n)
    integer, intent(in) :: clampl, clampr
    ! How often all of it is done, for timing
    integer, intent(in) :: repeat
    ! Deflection, moment (sagging), reaction (up); 1 where a support acts
    double precision, intent(out), target :: w(0:n), m(0:n), r(0:n)
    integer, intent(out) :: closed(0:n)
    ! Schemes solved; 0 solved, 1 matrix singular or not positive definite, 2 no scheme found
    integer, intent(out) :: solves, status
    !f2py threadsafe
    !f2py integer, intent(hide), depend(length) :: n = shape(length, 0)
    type(beam_type) :: beam
    type(answer_type) :: answer
    type(mixed_type) :: mixed
    type(displacement_type) :: displacement
    logical, allocatable :: acting(:)
    integer :: turn

    w = 0.0d0
    m = 0.0d0
    r = 0.0d0
    beam%length => length
    beam%ei => ei
    beam%q => q
    beam%side(0:) => side
    beam%stiff(0:) => stiff
    beam%level(0:) => level
    beam%force(0:) => force
    beam%clamped = [clampl == 1, clampr == 1]
    answer%w(0:) => w
    answer%m(0:) => m
    answer%r(0:) => r
    allocate (acting(0:n))
    mixed%by_lapack = method == 1
    mixed%refinements = refine
    mixed%precise = precis == 1
    mixed%reactions = react == 1
    displacement%incremental = method == 3
    do turn = 1, repeat
        if (method <= 1) then
            call find_contact_state(mixed, beam, answer, acting, solves, status)
        else if (method == 4) then
            call solve_condensed(beam, answer, acting, solves, status)
        else
            if (turn > 1) call displacement%restart()
            call find_contact_state(displacement, beam, answer, acting, solves, status)
        end if
    end do
    closed = merge(1, 0, acting)
end subroutine ysbeam

! A triad, a = b + s c, to measure the bandwidth of the memory: 24 bytes an element are read and written
subroutine ystria(n, repeat, a)
    implicit none
    integer, intent(in) :: n, repeat
    double precision, intent(out) :: a(n)
    !f2py threadsafe
    double precision, allocatable :: b(:), c(:)
    integer :: turn

    allocate (b(n), c(n))
    b(:) = 1.0d0
    c(:) = 2.0d0
    do turn = 1, repeat
        a(:) = b + turn*c
        ! Else a clever compiler does only the last turn
        b(1) = a(n)
    end do
end subroutine ystria

! TURNS rounds of multiplications and additions, as many at a time as a core can do: OPERAT is how many they were, VALUE is 10
subroutine yspeak(turns, operat, value)
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    implicit none
    integer, intent(in) :: turns
    double precision, intent(out) :: operat, value
    !f2py threadsafe
    interface
        ! yardstick_peak.c
        function peak(rounds, operations) result(answer) bind(c, name="yardstick_peak")
            import :: c_int, c_double
            implicit none
            integer(c_int), intent(in), value :: rounds
            real(c_double), intent(out) :: operations
            real(c_double) :: answer
        end function peak
    end interface

    value = peak(int(turns, c_int), operat)
end subroutine yspeak

! Bytes a node that plain solves keep: by the engine's elimination, by dgbsv, by GBKERN, which eliminates two nodes at once
subroutine ysbyte(bytes)
    use gapbeam_kernel, only: eliminated_type
    use yardstick_mixed, only: state_bytes
    implicit none
    integer, intent(out) :: bytes(3)
    type(eliminated_type) :: pair

    bytes = [state_bytes(.false.), state_bytes(.true.), storage_size(pair)/16]
end subroutine ysbyte

! Deflections and moments of a beam of N elements over two-sided supports, REPEAT times (for measuring)
subroutine yskern(n, length, ei, q, stiff, force, refine, repeat, w, m, status)
    use gapbeam_error, only: gapbeam_no_memory
    use gapbeam_kernel, only: eliminated_type, last_step
    use gapbeam_elements, only: solve_elements, refine_elements, elements_solved
    implicit none
    integer, intent(in) :: n
    double precision, intent(in) :: length(n), ei(n), q(n)
    ! At the nodes: stiffness of the supports (infinite: rigid), forces down
    double precision, intent(in) :: stiff(0:n), force(0:n)
    ! Steps of refinement
    integer, intent(in) :: refine, repeat
    double precision, intent(out) :: w(0:n), m(0:n)
    ! 0 solved, 1 an end without support, 2 a length or EI that is not positive; or GAPBEAM_NO_MEMORY
    integer, intent(out) :: status
    !f2py threadsafe
    !f2py integer, intent(hide), depend(length) :: n = shape(length, 0)
    type(eliminated_type), allocatable :: eliminated(:)
    double precision, allocatable :: correction(:, :)
    integer :: k, step, stat

    w = 0.0d0
    m = 0.0d0
    status = gapbeam_no_memory
    allocate (eliminated(0:last_step(n)), correction(0:n, 2), stat=stat)
    if (stat /= 0) return
    do k = 1, repeat
        call solve_elements(length, ei, q, stiff, force, eliminated, w, m, status)
        if (status /= elements_solved) return
        do step = 1, refine
            call refine_elements(length, ei, q, stiff, force, eliminated, correction, w, m)
        end do
    end do
end subroutine yskern
