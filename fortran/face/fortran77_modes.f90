! Axial forces that bending feels, buckling and frequencies in the Fortran 77 interface; all else is said in fortran77.f90 and
! fortran77_ground.f90. Marshalling only.
!
!     AXIAL(2, NSPAN)   axial force N, tension positive; mass per length, for frequencies, 0 or more, in the unit of force times
!                       the square of that of time over that of length
!     SHEAR(NFOUND)     second parameter of every foundation (force), 0 or more: what resists differences of their deflection; of
!                       those that hold both ways by a modulus
!     IGROW             0: N is the same at all load factors; 1: it grows with them, N at load factor 1; 2 more: axial loads have no
!                       effect on bending, as in beams of the other routines; 4 more: what deflections lengthen it by pulls it;
!                       8 more: trains will pass over hinges with a stiffness
!
!     AMASS(2, NMASS)   of lumped masses, for frequencies: x, and the mass, 0 or more, in the unit of force times the square of that
!                       of time over that of length
!
!     ISEC(3, NSEC)     of sections: which powers of a linear depth EI, GA and EA are, 1 to 4
!     SEC(12, NSEC)     of sections: left and right end; EI at both; GA at both; EA at both; N; most force per length with which
!                       ground holds the beam along its axis, 0 or more, at both; force per length of that ground for each
!                       displacement before the beam slides, above 0 (GBINF(): rigid). GBSAME() stands for what stays as it is,
!                       and for the right end of the beam; at the right end of other values for that at the left one
!
!     KIND              of modes: 1 buckling, 2 vibration, with the supports and the ground that act in a solved state

! Prepare a beam whose bending feels axial forces, also on foundations, and whose supports may follow laws
subroutine ghpraf(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, found, &
                  nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, axial, shear, igrow, beam, ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! As for GHPRFD
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw, ntab
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *)
    double precision, intent(in) :: glaw(6, *), atab(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*), iglaw(*), itab(2, *)
    ! See above
    double precision, intent(in) :: axial(2, *), shear(*)
    integer, intent(in) :: igrow
    ! As from GHPREP
    integer(8), intent(out) :: beam
    integer, intent(out) :: ientry
    ! -1 to -28 as from GHPRFD; -29: AXIAL(., IENTRY); -30: SHEAR(IENTRY), also beside what it is not available with; -31: IGROW;
    ! 14, 15
    integer, intent(out) :: info

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, &
                 found, nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, beam, ientry, info, &
                 axial=axial, shear=shear, igrow=igrow)
end subroutine ghpraf

! The same with lumped masses
subroutine ghprlm(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, found, &
                  nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, axial, shear, igrow, nmass, &
                  amass, beam, ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! As for GHPRAF
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw, ntab
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *)
    double precision, intent(in) :: glaw(6, *), atab(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*), iglaw(*), itab(2, *)
    ! See above; NMASS 0 or more
    double precision, intent(in) :: axial(2, *), shear(*), amass(2, *)
    integer, intent(in) :: igrow, nmass
    ! As from GHPREP
    integer(8), intent(out) :: beam
    integer, intent(out) :: ientry
    ! -1 to -31 as from GHPRAF; -32: NMASS; -33: AMASS(., IENTRY); 14, 15
    integer, intent(out) :: info

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, &
                 found, nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, beam, ientry, info, &
                 axial=axial, shear=shear, igrow=igrow, nmass=nmass, amass=amass)
end subroutine ghprlm

! The same with sections
subroutine ghprsc(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, found, &
                  nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, axial, shear, igrow, nmass, &
                  amass, nsec, isec, sec, beam, ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! As for GHPRLM
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw, ntab
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *)
    double precision, intent(in) :: glaw(6, *), atab(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*), iglaw(*), itab(2, *)
    double precision, intent(in) :: axial(2, *), shear(*), amass(2, *)
    integer, intent(in) :: igrow, nmass
    ! See above; NSEC 0 or more
    integer, intent(in) :: nsec, isec(3, *)
    double precision, intent(in) :: sec(12, *)
    ! As from GHPREP
    integer(8), intent(out) :: beam
    integer, intent(out) :: ientry
    ! -1 to -33 as from GHPRLM; -34: NSEC; -36: SEC(., IENTRY) or ISEC(., IENTRY); 14, 15
    integer, intent(out) :: info

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, &
                 found, nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, beam, ientry, info, &
                 axial=axial, shear=shear, igrow=igrow, nmass=nmass, amass=amass, nsec=nsec, isec=isec, sec=sec)
end subroutine ghprsc

! Is a solved state known to be the only one
subroutine ghuniq(state, iuniq, info)
    use gapbeam_fortran77_info, only: handle_type, state_tag, find_first
    implicit none
    integer(8), intent(in) :: state
    ! 1: it is; 0: under compression there may be others, this one is reached as the axial forces grow
    integer, intent(inout) :: iuniq
    ! -1, also where nothing is solved
    integer, intent(out) :: info
    type(handle_type), pointer :: solved

    call find_first(state, state_tag, solved, info)
    if (info /= 0) return
    if (solved%result%status /= 0) info = -1
    if (info == 0) iuniq = merge(1, 0, solved%result%unique)
end subroutine ghuniq

! How a beam gives way that does not bear its axial forces
subroutine ghbuck(beam, state, share, maxx, nx, x, w, info)
    use gapbeam_api_modes, only: get_buckling
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! How much of them it bears, all other loads in full
    double precision, intent(inout) :: share
    ! Room for places, 0 or more
    integer, intent(in) :: maxx
    ! Number of places, which may be more than MAXX
    integer, intent(inout) :: nx
    ! The first MAXX of them, and deflections as it gives way, the largest 1
    double precision, intent(inout) :: x(*), w(*)
    ! -1; -2, also of a state that does not buckle; -4; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    double precision, allocatable :: places(:), deflections(:)
    double precision :: borne
    integer :: n

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. maxx < 0) info = -4
    if (info /= 0) return
    call get_buckling(prepared%beam, solved%result, borne, places, deflections, error)
    info = info_of(error, 2)
    if (info /= 0) return
    share = borne
    nx = size(places)
    n = min(maxx, nx)
    x(1:n) = places(:n)
    w(1:n) = deflections(:n)
end subroutine ghbuck

! The first values of modes, in rising order
subroutine ghmode(beam, state, kind, nval, value, nfound, info)
    use gapbeam_api_modes, only: get_modes
    use gapbeam_fortran77_info, only: error_type, gapbeam_no_memory, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! 1: factors of all axial forces at which it buckles; 2: circular frequencies (rad per unit of time)
    integer, intent(in) :: kind
    ! How many are wanted
    integer, intent(in) :: nval
    ! The first NFOUND ones are written
    double precision, intent(inout) :: value(*)
    integer, intent(inout) :: nfound
    ! -1; -2, also of a state that is not solved, or where modes are not available (curves of the ground); -3, -4; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    double precision, allocatable :: values(:)
    integer :: n, stat

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. nval < 0) info = -4
    if (info /= 0) return
    allocate (values(nval), stat=stat)
    if (stat /= 0) info = gapbeam_no_memory
    if (info /= 0) return
    call get_modes(prepared%beam, solved%result, kind, values, n, error)
    info = info_of(error, 2, ["kind"], [3])
    if (info /= 0) return
    nfound = n
    value(1:n) = values(:n)
end subroutine ghmode

! How the beam moves in a mode
subroutine ghshap(beam, state, kind, value, nparts, maxx, nx, x, w, xmom, info)
    use gapbeam_api_modes, only: get_mode_shape
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! As for GHMODE, and one of its values
    integer, intent(in) :: kind
    double precision, intent(in) :: value
    ! Intervals between places on every stretch of the beam at least, 1 or more; room for places, 0 or more
    integer, intent(in) :: nparts, maxx
    ! Number of places, which may be more than MAXX
    integer, intent(inout) :: nx
    ! The first MAXX of them, deflections there, the largest 1, and moments left and right of them with these
    double precision, intent(inout) :: x(*), w(*), xmom(2, *)
    ! -1, -2, -3 as from GHMODE; -2 also where there is no such mode; -4, -5, -6; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    double precision, allocatable :: places(:), deflections(:), moments(:, :)
    ! (Written where they are used, gfortran keeps their addresses in writable storage)
    character(len=6), parameter :: names(3) = ["kind  ", "value ", "parts "]
    integer :: n

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. maxx < 0) info = -6
    if (info /= 0) return
    call get_mode_shape(prepared%beam, solved%result, kind, value, nparts, places, deflections, moments, error)
    info = info_of(error, 2, names, [3, 4, 5])
    if (info /= 0) return
    nx = size(places)
    n = min(maxx, nx)
    x(1:n) = places(:n)
    w(1:n) = deflections(:n)
    xmom(:, 1:n) = moments(:, :n)
end subroutine ghshap

! How far a mode may swing before a support closes or opens
subroutine ghampl(beam, state, kind, value, nparts, ampl, ksup, info)
    use gapbeam_api_modes, only: get_mode_amplitude
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    ! As for GHSHAP
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: kind, nparts
    double precision, intent(in) :: value
    ! How many times the deflections of GHSHAP swing when a support closes or opens first, and which one; infinite and 0 where none
    ! does
    double precision, intent(inout) :: ampl
    integer, intent(inout) :: ksup
    ! -1 to -5 as from GHSHAP; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    double precision :: swing
    integer :: first
    character(len=6), parameter :: names(3) = ["kind  ", "value ", "parts "]

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info /= 0) return
    call get_mode_amplitude(prepared%beam, solved%result, kind, value, nparts, swing, first, error)
    info = info_of(error, 2, names, [3, 4, 5])
    if (info /= 0) return
    ampl = swing
    ksup = first
end subroutine ghampl
