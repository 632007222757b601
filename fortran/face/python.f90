! The library for Python: plain arrays only, in the manner of Fortran 77. f2py reads this very file, so it holds only default
! kinds, explicit shapes and external subroutines, and nothing but marshalling. It is no part of the library for everyone else.
!
! BEAM is the handle of a prepared beam (gapbeam_handles): NP pieces, NL links between nodes 0 to NL, NS supports of the engine,
! NM supports of the scene, NB axial bars. Arrays over supports and bars have one entry more than there are: f2py takes none
! that is empty. Units are the engine's where nothing else is said. STATUS as in gapbeam_error: 0 solved, 1 no equilibrium, above
! 10 an error with its MESSAGE and nothing else set.

! Thresholds and limits that Python reads too
subroutine gbtole(place, endtol, begin, equal, lacks, segmts, change)
    use gapbeam_tolerances, only: position_tolerance, end_tolerance
    use gapbeam_path_tolerances, only: load_begin, train_equal, missing_of_limit
    use gapbeam_limits, only: most_path_segments, changes_at_a_time
    implicit none
    ! POSITION_TOLERANCE, END_TOLERANCE, LOAD_BEGIN, TRAIN_EQUAL
    double precision, intent(out) :: place, endtol, begin, equal
    ! MISSING_OF_LIMIT
    double precision, intent(out) :: lacks(2)
    ! MOST_PATH_SEGMENTS, CHANGES_AT_A_TIME
    integer, intent(out) :: segmts, change

    place = position_tolerance
    endtol = end_tolerance
    begin = load_begin
    equal = train_equal
    lacks = missing_of_limit
    segmts = most_path_segments
    change = changes_at_a_time
end subroutine gbtole

! Prepare a beam
subroutine gbmake(mspan, mhinge, msect, msup, mlaw, mload, mfound, mprof, mflaw, mmass, span, hinge, sect, isup, sup, ilaw, &
                  alaw, iload, aload, ifound, found, iprof, aprof, iflaw, aflaw, amass, forces, thread, &
                  beam, status, reason, table, entry, partner, key, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, new_beam, listen, report
    use gapbeam_handles, only: finish_handle
    use gapbeam_arrays, only: model_from_arrays, foundations_from_arrays
    use gapbeam_assemble, only: assemble_model
    implicit none
    ! One more than there are
    integer, intent(in) :: mspan, mhinge, msect, msup, mlaw, mload, mfound, mprof, mflaw, mmass
    ! As for model_from_arrays, in the scene's units
    double precision, intent(in) :: span(6, mspan), hinge(2, mhinge), sect(15, msect), sup(9, msup), alaw(2, mlaw), aload(4, mload)
    integer, intent(in) :: isup(5, msup), ilaw(mlaw), iload(3, mload)
    ! As for foundations_from_arrays
    integer, intent(in) :: ifound(mfound), iprof(mprof), iflaw(mflaw)
    double precision, intent(in) :: found(14, mfound), aprof(3, mprof), aflaw(3, mflaw)
    ! Places of lumped masses, and these
    double precision, intent(in) :: amass(2, mmass)
    ! Does N grow with the load factor (1); do axial loads have no effect on bending (1); do deflections stretch
    ! it (1); do trains pass over it (1)
    integer, intent(in) :: forces(4)
    ! Python's main thread, which hears signals
    integer(8), intent(in) :: thread
    ! The handle; 0 where it is refused
    integer(8), intent(out) :: beam
    ! Why: as in gapbeam_error and gapbeam_input_error; entries count from 1
    integer, intent(out) :: status, reason, table, entry, partner
    character(len=16), intent(out) :: key
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    reason = 0
    table = 0
    entry = 0
    partner = 0
    key = " "
    call new_beam(handle, error)
    if (.not. allocated(error)) then
        associate (model => handle%beam%lowered%model)
            call model_from_arrays(span(:, :mspan - 1), hinge(:, :mhinge - 1), sect(:, :msect - 1), isup(:, :msup - 1), &
                                   sup(:, :msup - 1), ilaw(:mlaw - 1), alaw(:, :mlaw - 1), iload(:, :mload - 1), &
                                   aload(:, :mload - 1), model, error)
            if (.not. allocated(error)) call foundations_from_arrays(ifound(:mfound - 1), found(:, :mfound - 1), &
                                                                     iprof(:mprof - 1), aprof(:, :mprof - 1), &
                                                                     iflaw(:mflaw - 1), aflaw(:, :mflaw - 1), model, error)
            model%masses = amass(:, :mmass - 1)
            model%N_grows = forces(1) /= 0
            model%first_order = forces(2) /= 0
            model%stretching = forces(3) /= 0
            model%with_trains = forces(4) /= 0
        end associate
        if (.not. allocated(error)) call assemble_model(handle%beam%lowered, error)
    end if
    call finish_handle(handle, error)
    beam = number_of(handle)
    call report(error, status, message)
    if (.not. allocated(error)) then
        call listen(handle, thread)
        return
    end if
    reason = error%reason
    table = error%table
    entry = error%entry
    partner = error%partner
    key = error%key
end subroutine gbmake

! End the calls with a beam that are at work, and those to come (ENDS = 1), until they may go on again (0)
subroutine gbstop(beam, ends)
    use gapbeam_python_handles, only: handle_type, behind, listen
    use gapbeam_watch, only: end_watched
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ends
    type(handle_type), pointer :: handle

    handle => behind(beam)
    if (ends /= 0) then
        call end_watched(handle%watch)
    else
        call listen(handle, handle%thread)
    end if
end subroutine gbstop

! Free what a handle stands for, whatever it is
subroutine gbdrop(handle)
    use gapbeam_handles, only: free_handle, address_numbered
    implicit none
    integer(8), intent(in) :: handle

    call free_handle(address_numbered(handle))
end subroutine gbdrop

! Another beam: the loads of a case, all live, each times its factor, and nothing dead
subroutine gbcopy(beam, nd, factor, copy, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, behind, copy_beam, report
    use gapbeam_cases, only: take_case
    use gapbeam_handles, only: finish_handle
    implicit none
    integer(8), intent(in) :: beam
    ! One more than there are loads
    integer, intent(in) :: nd
    double precision, intent(in) :: factor(nd)
    integer(8), intent(out) :: copy
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, other
    type(error_type), allocatable :: error

    handle => behind(beam)
    call copy_beam(handle, other, error)
    if (.not. allocated(error)) call take_case(factor(:nd - 1), other%beam%lowered, error)
    call finish_handle(other, error)
    copy = number_of(other)
    call report(error, status, message)
end subroutine gbcopy

! Sizes of a beam, and its units
subroutine gbsize(beam, sizes, units)
    use gapbeam_python_handles, only: handle_type, behind
    implicit none
    integer(8), intent(in) :: beam
    ! NP, NL, NS, NM, NB (-1 without an axial system), and whether there are hinges, rotational restraints, shear
    ! flexibility, one-sided supports that can carry, laws, laws on whose path the state depends, links along
    ! the beam (1) or ground (2); layers of ground, -1 where it is not solved in stretches; does bending feel axial forces that
    ! are given (1), and those of loads (2)
    integer, intent(out) :: sizes(14)
    ! Exponents of two: length, force, deflection
    integer, intent(out) :: units(3)
    type(handle_type), pointer :: handle

    handle => behind(beam)
    associate (lowered => handle%beam%lowered)
        sizes = [size(lowered%pieces), size(lowered%beam%links), size(lowered%beam%supports), size(lowered%model%supports), -1, &
                 size(lowered%model%hinges), merge(1, 0, any(lowered%turning > 0.0d0)), &
                 merge(1, 0, any(lowered%pieces%shear_flexibility > 0.0d0)), merge(1, 0, any(lowered%beam%supports%side /= 0)), &
                 merge(1, 0, size(lowered%law) > 0), merge(1, 0, lowered%depends_on_path), &
                 merge(1, 0, allocated(lowered%axial%laws)) + merge(2, 0, allocated(lowered%axial%limit)), -1, &
                 merge(1, 0, any(abs(lowered%pieces%tension) > 0.0d0)) + merge(2, 0, lowered%model%axial_loads_bend)]
        if (allocated(lowered%layers)) sizes(13) = size(lowered%layers)
        units = [lowered%units%length, lowered%units%force, lowered%units%deflection]
        if (allocated(lowered%axial%point)) sizes(5) = ubound(lowered%axial%point, 1)
    end associate
end subroutine gbsize

! Which supports of the scene those of the engine are
subroutine gbnumb(beam, ns, number, laws)
    use gapbeam_python_handles, only: handle_type, behind, put_laws
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ns
    ! Number in the scene, from 0; of a law once for every kink
    integer, intent(out) :: number(ns + 1)
    ! Contact level, force, slope and slope before of every support
    double precision, intent(out) :: laws(4, ns + 1)
    type(handle_type), pointer :: handle

    handle => behind(beam)
    number = 0
    laws = 0.0d0
    number(:ns) = handle%beam%lowered%normal - 1
    call put_laws(handle%beam%lowered%beam%supports, laws)
end subroutine gbnumb

! What there is along a beam, in the scene's units
subroutine gbplac(beam, np, nl, ns, nm, xend, xpoint, ispan, piece, dead, live, npoint, kind, turn, force, couple, snode, level)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_units, only: rotation_unit, moment_unit
    use gapbeam_assembled_model, only: point_x, piece_length, in_bending, in_shear
    use gapbeam_model, only: node_of_support
    use gapbeam_piece_stiffness, only: least_stiffness_of
    use gapbeam_assemble_supports, only: contact_level
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: np, nl, ns, nm
    ! The beam's right end; places of the points between pieces, and span of every piece, from 0
    double precision, intent(out) :: xend, xpoint(0:np)
    integer, intent(out) :: ispan(np)
    ! Length, EI, GA of the pieces, and loads on them: per length at both ends, imposed curvature, force and couple at the right
    ! end unless a node is there, and by how much that curvature rises along it
    double precision, intent(out) :: piece(3, np), dead(6, np), live(6, np)
    ! Points that are nodes; 0 plain, 1 hinge, 2 rotational restraint of stiffness TURN; dead and live forces and couples
    integer, intent(out) :: npoint(0:nl), kind(0:nl)
    double precision, intent(out) :: turn(0:nl), force(2, 0:nl), couple(2, 0:nl)
    ! Node of the supports of the engine
    integer, intent(out) :: snode(ns + 1)
    ! Deflection at which a support of the scene begins to act; 0 for axial ones
    double precision, intent(out) :: level(nm + 1)
    !f2py threadsafe
    type(handle_type), pointer :: handle
    integer :: j, k

    handle => behind(beam)
    associate (lowered => handle%beam%lowered, units => handle%beam%lowered%units)
        xend = lowered%ends(ubound(lowered%ends, 1))
        do j = 0, np
            xpoint(j) = point_x(lowered, j)
        end do
        ispan = lowered%point_span(:np - 1)
        do j = 1, np
            piece(:, j) = [piece_length(lowered, j), least_stiffness_of(lowered, j, in_bending), &
                           least_stiffness_of(lowered, j, in_shear)]
            associate (a => lowered%dead(j), b => lowered%live(j), q => units%force - units%length, &
                       bent => rotation_unit(units) - units%length)
                dead(:, j) = scale([a%qa, a%qb, a%kappa, a%force, a%couple, a%rise], &
                                   [q, q, bent, units%force, moment_unit(units), bent])
                live(:, j) = scale([b%qa, b%qb, b%kappa, b%force, b%couple, b%rise], &
                                   [q, q, bent, units%force, moment_unit(units), bent])
            end associate
        end do
        npoint = lowered%node_point
        kind = lowered%beam%kind
        turn = lowered%turning
        force = scale(lowered%beam%force, units%force)
        couple = scale(lowered%beam%couple, moment_unit(units))
        snode = 0
        snode(:ns) = [(node_of_support(lowered%beam, k), k=1, ns)]
        level = 0.0d0
        do k = 1, nm
            if (lowered%model%supports(k)%direction /= 0) cycle
            level(k) = contact_level(lowered%model%supports(k))
            if (allocated(lowered%growth)) level(k) = level(k) + lowered%growth(k)
        end do
    end associate
end subroutine gbplac

! Another beam: the same with the laws of its supports as they have become
subroutine gblaws(beam, ns, laws, copy, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, behind, copy_beam, laws_given, report
    use gapbeam_assemble_laws, only: depends_on_path
    implicit none
    integer(8), intent(in) :: beam
    ! As from GBHGET
    integer, intent(in) :: ns
    double precision, intent(in) :: laws(4, ns)
    integer(8), intent(out) :: copy
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, other
    type(error_type), allocatable :: error

    handle => behind(beam)
    call copy_beam(handle, other, error)
    copy = number_of(other)
    call report(error, status, message)
    if (allocated(error)) return
    other%beam%lowered%beam%supports = laws_given(handle%beam%lowered, laws(:, :ns - 1))
    other%beam%lowered%depends_on_path = depends_on_path(other%beam%lowered)
end subroutine gblaws
