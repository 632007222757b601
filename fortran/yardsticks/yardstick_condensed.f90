!> The engine's normal route, called as Fortran 77 calls it: what is not a support is condensed and recovered afterwards
module yardstick_condensed
    use gapbeam_kinds, only: wp
    use yardstick_beam, only: beam_type, answer_type, solved, singular
    implicit none
    private
    public :: solve_condensed

    !> Numbers of an opaque link, see gapbeam_f2py.f90
    integer, parameter :: link_size = 21

    interface
        subroutine gbcond(np, nl, piece, dead, live, last, link)
            import :: wp, link_size
            implicit none
            integer, intent(in) :: np, nl
            real(wp), intent(in) :: piece(3, np), dead(5, np), live(5, np)
            integer, intent(in) :: last(nl)
            real(wp), intent(out) :: link(link_size, nl)
        end subroutine gbcond
        subroutine gbsolv(nl, ns, link, kind, compli, force, couple, snode, sside, sstiff, scont, factor, rule, &
                          closed, margin, w, ml, mr, shear, react, motion, resid, solves, method, indiff, status, message)
            import :: wp, link_size
            implicit none
            integer, intent(in) :: nl, ns, kind(0:nl), snode(ns), sside(ns), rule
            real(wp), intent(in) :: link(link_size, nl), compli(0:nl), force(2, 0:nl), couple(2, 0:nl)
            real(wp), intent(in) :: sstiff(ns), scont(ns), factor
            integer, intent(inout) :: closed(ns)
            integer, intent(out) :: margin(ns), solves, method, indiff, status
            real(wp), intent(out) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl), react(ns), motion(0:nl), resid(3)
            character(len=240), intent(out) :: message
        end subroutine gbsolv
        subroutine gbreco(np, nl, piece, dead, live, factor, link, last, kind, w, ml, mr, shear, start)
            import :: wp, link_size
            implicit none
            integer, intent(in) :: np, nl, last(nl), kind(0:nl)
            real(wp), intent(in) :: piece(3, np), dead(5, np), live(5, np), factor, link(link_size, nl)
            real(wp), intent(in) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl)
            real(wp), intent(out) :: start(4, np)
        end subroutine gbreco
    end interface

contains

    !> Solve a beam, its working scheme included
    subroutine solve_condensed(beam, answer, closed, solves, status)
        !> The beam and where its answer goes
        type(beam_type), intent(in) :: beam
        type(answer_type), intent(in) :: answer
        !> The working scheme, shape (0:n)
        logical, intent(out) :: closed(0:)
        !> Linear solves
        integer, intent(out) :: solves
        !> solved or singular
        integer, intent(out) :: status
        real(wp), allocatable :: piece(:, :), load(:, :), none(:, :), link(:, :), start(:, :), force(:, :), couple(:, :)
        real(wp), allocatable :: compliance(:), w(:), ml(:), mr(:), shear(:), react(:), motion(:)
        integer, allocatable :: at(:), kind(:), node(:), acting(:), margin(:), support(:)
        real(wp) :: residuals(3)
        integer :: n, nl, ns, i, k, method, indifferent
        character(len=240) :: message

        n = size(beam%length)
        support = pack([(i, i=0, n)], beam%stiff > 0.0_wp)
        at = pack([(i, i=0, n)], beam%stiff > 0.0_wp .or. [(i == 0 .or. i == n, i=0, n)])
        ns = size(support)
        nl = size(at) - 1
        allocate (piece(3, n), load(5, n), none(5, n), link(link_size, nl), start(4, n))
        allocate (force(2, 0:nl), couple(2, 0:nl), compliance(0:nl), w(0:nl), ml(0:nl), mr(0:nl), motion(0:nl), kind(0:nl))
        allocate (shear(nl), react(ns), node(ns), acting(ns), margin(ns))
        none = 0.0_wp
        do i = 1, n
            piece(:, i) = [beam%length(i), 1/beam%ei(i), 0.0_wp]
            load(:, i) = [beam%q(i), beam%q(i), 0.0_wp, beam%force(i), 0.0_wp]
        end do
        force = 0.0_wp
        couple = 0.0_wp
        compliance = 0.0_wp
        kind = 0
        do k = 0, nl
            i = at(k + 1)
            force(2, k) = beam%force(i)
            if (i > 0) load(4, i) = 0.0_wp
        end do
        if (beam%clamped(1)) kind(0) = 2
        if (beam%clamped(2)) kind(nl) = 2
        k = 0
        do i = 1, ns
            do while (at(k + 1) /= support(i))
                k = k + 1
            end do
            node(i) = k
        end do
        acting = 1
        call gbcond(n, nl, piece, none, load, at(2:), link)
        call gbsolv(nl, ns, link, kind, compliance, force, couple, node, beam%side(support), beam%stiff(support), &
                    beam%level(support), 1.0_wp, 0, acting, margin, w, ml, mr, shear, react, motion, residuals, &
                    solves, method, indifferent, status, message)
        closed = .false.
        status = merge(solved, singular, status == 0)
        if (status /= solved) return
        call gbreco(n, nl, piece, none, load, 1.0_wp, link, at(2:), kind, w, ml, mr, shear, start)
        answer%w(0:n - 1) = start(1, :)
        answer%m(0:n - 1) = start(3, :)
        answer%w(n) = w(nl)
        answer%m(n) = ml(nl)
        answer%r = 0.0_wp
        answer%r(support) = react
        closed(support) = acting /= 0
    end subroutine solve_condensed

end module yardstick_condensed
