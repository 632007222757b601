!> Prepared beams and states in the work arrays of the Fortran 77 interface: how much they take, put in, taken out
module gapbeam_work
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, gapbeam_bad_input, gapbeam_no_memory
    use gapbeam_search, only: rule_block, rule_single
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_scene, only: model_type, gapbeam_elastic
    use gapbeam_api, only: prepared_type, result_type, prepare_model
    use gapbeam_api_objects, only: summarise
    use gapbeam_layers, only: parameters_of_law
    use gapbeam_input_error, only: of_foundations, not_expected
    use gapbeam_arrays, only: model_from_arrays, foundations_from_arrays
    use gapbeam_tape, only: tape_type, writing, reading
    use gapbeam_pack, only: exchange_beam, exchange_state
    use gapbeam_pack_ground, only: add_likely_solution
    implicit none
    private
    public :: prepare_beam, put_beam, take_beam, put_result, take_result, begin_result, check_history, take_both

    !> Marks of what a pair of work arrays holds, in the first integer; the next two are the lengths used
    integer, parameter :: beam_mark = 770042, state_mark = 770043, header = 3

contains

    !> What GBPREP, GBPRLW, GBPRFD and GBPRGL do, with the arguments of the last
    subroutine prepare_beam(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, &
                            nfound, ifound, found, nprof, iprof, aprof, nflaw, iflaw, aflaw, nglaw, iglaw, glaw, &
                            work, lwork, iwork, liwork, info)
        integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw
        !> Foundations that have an entry in `iglaw` and `glaw`: all or none
        integer, intent(in) :: nglaw
        real(wp), intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *)
        real(wp), intent(in) :: glaw(2*parameters_of_law, *)
        integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*), iglaw(*)
        integer, intent(in) :: lwork, liwork
        real(wp), intent(inout) :: work(*)
        integer, intent(inout) :: iwork(*)
        integer, intent(out) :: info
        type(prepared_type) :: beam
        type(error_type), allocatable :: error
        integer(int64) :: reals, integers, layers
        integer :: short

        info = 0
        if (nspan < 1) info = -1
        if (nhinge < 0) info = -3
        if (nsup < 0) info = -5
        if (nload < 0) info = -8
        if (nlaw < 0) info = -11
        if (nfound < 0) info = -15
        if (nprof < 0) info = -18
        if (nflaw < 0) info = -21
        if (info /= 0) return
        layers = 0
        if (lwork == -1 .or. liwork == -1) then
            if (nfound > 0) then
                ! How many layers there are shows when the beam is cut into pieces; every place of a load may cut one more
                call make(0)
                if (allocated(error)) return
                associate (first => beam%lowered%layer_first)
                    layers = size(beam%lowered%layers, kind=int64) &
                        + 2_int64*nload*maxval(first(2:) - first(:size(first) - 1))
                end associate
            end if
            call sizes_of_beam(nspan, nhinge, nsup, nlaw, nload, nfound, nprof, nflaw, layers, reals, integers)
            if (max(reals, integers) > huge(info)) info = gapbeam_no_memory
            if (info /= 0) return
            work(1) = real(reals, wp)
            iwork(1) = int(integers)
            return
        end if
        if (nfound == 0) then
            call sizes_of_beam(nspan, nhinge, nsup, nlaw, nload, nfound, nprof, nflaw, layers, reals, integers)
            if (max(reals, integers) > huge(info)) info = gapbeam_no_memory
            if (lwork < reals) info = -27
            if (liwork < integers) info = -29
            if (info /= 0) return
        end if
        iwork(1) = 0
        call make(nload)
        if (allocated(error)) return
        call put_beam(beam, work, lwork, iwork, liwork, short)
        if (short > 0) info = merge(-27, -29, short == 1)

    contains

        !> Prepare it with its first loads
        subroutine make(loads)
            integer, intent(in) :: loads
            type(model_type) :: model
            real(wp) :: no_sections(5, 0), whole(7 + 2*parameters_of_law, nglaw)
            ! The argument that an array of the model is; of a pair of arrays the first, which has the number of entries
            integer, parameter :: argument(0:6) = [1, 2, 4, 6, 9, 0, 16]

            call model_from_arrays(span(:, 1:nspan), hinge(1:nhinge), no_sections, isup(:, 1:nsup), sup(:, 1:nsup), &
                                   ilaw(1:nlaw), alaw(:, 1:nlaw), iload(:, 1:loads), aload(:, 1:loads), model, error)
            if (.not. allocated(error) .and. nglaw > 0) then
                whole(:6, :) = found(:, 1:nfound)
                whole(7, :) = iglaw(1:nfound)
                whole(8:, :) = glaw(:, 1:nfound)
                call foundations_from_arrays(ifound(1:nfound), whole, iprof(1:nprof), aprof(:, 1:nprof), iflaw(1:nflaw), &
                                             aflaw(:, 1:nflaw), model, error)
            else if (.not. allocated(error)) then
                call foundations_from_arrays(ifound(1:nfound), found(:, 1:nfound), iprof(1:nprof), aprof(:, 1:nprof), &
                                             iflaw(1:nflaw), aflaw(:, 1:nflaw), model, error)
            end if
            if (.not. allocated(error)) then
                if (nlaw > 0) model%supports%unloading = iunl(1:nsup)
                call prepare_model(model, beam, error)
            end if
            if (.not. allocated(error)) return
            info = error%code
            if (error%code == gapbeam_bad_input) then
                info = -argument(error%table)
                if (error%key == "law") info = merge(-22, -12, error%table == of_foundations)
                if (error%key == "law" .and. error%table == of_foundations .and. error%reason == not_expected) info = -24
                if (index(error%key, "law.") == 1) info = -25
                if (error%key == "profile") info = -19
                if (error%key == "unloading") info = -14
            end if
            iwork(1) = error%entry
        end subroutine make

    end subroutine prepare_beam

    !> Lengths that are enough for any beam of these sizes
    pure subroutine sizes_of_beam(spans, hinges, supports, laws, loads, foundations, profiles, ground_laws, layers, reals, integers)
        !> Numbers of entries; of laws and profiles that of their points; layers of ground under all pieces
        integer, intent(in) :: spans, hinges, supports, laws, loads, foundations, profiles, ground_laws
        integer(int64), intent(in) :: layers
        !> Lengths of the two work arrays
        integer(int64), intent(out) :: reals, integers
        integer(int64) :: points, nodes, kinks

        ! No more points than places given, no more nodes than hinges, supports and places of loads beside the two ends; with
        ! foundations all points are nodes
        points = 1_int64 + spans + hinges + supports + 2_int64*loads + 2_int64*foundations + profiles
        nodes = points
        if (foundations == 0) nodes = min(points, 2_int64 + hinges + supports + 2_int64*loads)
        ! A support that holds both ways has every point of its law twice
        kinks = supports + 2_int64*laws
        reals = 5_int64*spans + hinges + 6_int64*supports + 4*kinks + 2_int64*laws + 4_int64*loads + 25*points + 27*nodes + 16 &
            + 12_int64*foundations + 2_int64*profiles + 11_int64*ground_laws + 10*layers
        integers = header + 2_int64*spans + 9_int64*supports + 7*kinks + laws + 5_int64*loads + 4*points + 3*nodes + 72 &
            + 4_int64*foundations + 3_int64*profiles + 2_int64*ground_laws + 5*layers
        if (foundations > 0) integers = integers + points
    end subroutine sizes_of_beam

    !> Lengths that a state of a beam takes, on the ground hardly ever exceeds
    subroutine sizes_of_state(beam, reals, integers, error)
        type(prepared_type), intent(in) :: beam
        integer(int64), intent(out) :: reals, integers
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(tape_type) :: tape
        type(state_type) :: state
        integer :: stat

        reals = 0
        integers = 0
        call new_state(beam%lowered, state, error)
        if (allocated(error)) return
        ! Laws that keep a set are kept with the state
        if (any(beam%lowered%model%supports%unloading /= gapbeam_elastic)) then
            allocate (state%laws(size(beam%lowered%beam%supports)), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            state%laws(:) = beam%lowered%beam%supports
        end if
        call exchange_state(tape, state)
        reals = tape%reals
        integers = tape%integers + header
        if (allocated(beam%lowered%layers)) call add_likely_solution(beam%lowered, reals, integers)
    end subroutine sizes_of_state

    !> Put a prepared beam into work arrays
    subroutine put_beam(beam, work, lwork, iwork, liwork, short)
        type(prepared_type), intent(inout) :: beam
        integer, intent(in) :: lwork, liwork
        real(wp), intent(inout), target :: work(*)
        integer, intent(inout), target :: iwork(*)
        !> 0; which of the two is too short, and nothing is written
        integer, intent(out) :: short
        type(tape_type) :: tape

        call exchange_beam(tape, beam%lowered)
        short = 0
        if (tape%integers + header > liwork) short = 2
        if (tape%reals > lwork) short = 1
        if (short > 0) return
        call start(tape, writing, work, int(lwork, int64), iwork, int(liwork, int64))
        iwork(1:header) = [beam_mark, lwork, liwork]
        call exchange_beam(tape, beam%lowered)
    end subroutine put_beam

    !> Take a prepared beam out of work arrays
    subroutine take_beam(work, iwork, place, beam, info)
        real(wp), intent(in), target :: work(*)
        integer, intent(in), target :: iwork(*)
        !> Of WORK among the arguments
        integer, intent(in) :: place
        type(prepared_type), intent(out) :: beam
        !> 0; -place: nothing prepared in there; or gapbeam_no_memory
        integer, intent(out) :: info
        type(tape_type) :: tape
        integer :: stat

        info = -place
        if (iwork(1) /= beam_mark) return
        info = gapbeam_no_memory
        allocate (beam%lowered, stat=stat)
        if (stat /= 0) return
        call start(tape, reading, work, int(iwork(2), int64), iwork, int(iwork(3), int64))
        call exchange_beam(tape, beam%lowered)
        if (tape%stat == 0) info = 0
    end subroutine take_beam

    !> Put a result into work arrays, and set INFO of GBSOLV, GBEVNT
    subroutine put_result(result, work, lwork, iwork, liwork, info)
        type(result_type), intent(inout) :: result
        integer, intent(in) :: lwork, liwork
        real(wp), intent(inout), target :: work(*)
        integer, intent(inout), target :: iwork(*)
        !> Status of the result; -7 or -9 where an array is too short: then the first entries are the lengths it takes
        integer, intent(out) :: info
        type(tape_type) :: tape
        integer(int64) :: integers

        call exchange_state(tape, result%state)
        integers = tape%integers + header
        info = result%status
        if (integers > liwork) info = -9
        if (tape%reals > lwork) info = -7
        if (max(tape%reals, integers) > huge(info)) info = gapbeam_no_memory
        if (info == -7 .or. info == -9) then
            work(1) = real(tape%reals, wp)
            iwork(1) = int(integers)
        end if
        if (info /= result%status) return
        call start(tape, writing, work, int(lwork, int64), iwork, int(liwork, int64))
        iwork(1:header) = [state_mark, lwork, liwork]
        call exchange_state(tape, result%state)
    end subroutine put_result

    !> Take a result out of work arrays
    subroutine take_result(work, iwork, place, result, info)
        real(wp), intent(in), target :: work(*)
        integer, intent(in), target :: iwork(*)
        !> Of the first one among the arguments
        integer, intent(in) :: place
        type(result_type), intent(out) :: result
        !> 0; -place: nothing solved in there; or gapbeam_no_memory
        integer, intent(out) :: info
        type(tape_type) :: tape
        integer :: stat

        info = -place
        if (iwork(1) /= state_mark) return
        info = gapbeam_no_memory
        allocate (result%state, stat=stat)
        if (stat /= 0) return
        call start(tape, reading, work, int(iwork(2), int64), iwork, int(iwork(3), int64))
        call exchange_state(tape, result%state)
        if (tape%stat /= 0) return
        call summarise(result)
        info = 0
    end subroutine take_result

    !> What GBSOLV and GBEVNT begin with: the beam, checks, and the answer to a query. The arguments stand at the places 1, 2, 3,
    !> 4 and 6 to 9 of both
    subroutine begin_result(work, iwork, factor, rule, state, lstate, istate, listat, beam, info)
        real(wp), intent(in) :: work(*)
        integer, intent(in) :: iwork(*)
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule, lstate, listat
        real(wp), intent(inout) :: state(*)
        integer, intent(inout) :: istate(*)
        type(prepared_type), intent(out) :: beam
        integer, intent(out) :: info
        type(error_type), allocatable :: error
        integer(int64) :: reals, integers

        call take_beam(work, iwork, 1, beam, info)
        if (info /= 0) return
        call sizes_of_state(beam, reals, integers, error)
        if (allocated(error)) then
            info = error%code
        else if (max(reals, integers) > huge(info)) then
            info = gapbeam_no_memory
        else if (lstate == -1 .or. listat == -1) then
            state(1) = real(reals, wp)
            istate(1) = int(integers)
        else if (.not. abs(factor) <= huge(factor)) then
            info = -3
        else if (rule /= rule_block .and. rule /= rule_single) then
            info = -4
        else if (lstate < reals) then
            info = -7
        else if (listat < integers) then
            info = -9
        end if
        ! As where there are more zones than is likely
        if (all(info /= [-7, -9]) .or. .not. allocated(beam%lowered%layers) .or. min(lstate, listat) < 1) return
        state(1) = real(reals, wp)
        istate(1) = int(integers)
    end subroutine begin_result

    !> INFO for arguments 3 to 5 of GBHIST and GBHSOL
    pure function check_history(nfact, factor, limit) result(info)
        integer, intent(in) :: nfact, limit
        real(wp), intent(in) :: factor(*)
        !> 0, -3, -4 or -5
        integer :: info

        info = 0
        if (limit < 0 .or. limit > 2) info = -5
        if (nfact < 1) then
            info = -3
        else if (.not. all(abs(factor(1:nfact)) <= huge(1.0_wp))) then
            info = -4
        end if
    end function check_history

    !> Beam and state, for the routines that have them as their first four arguments
    subroutine take_both(work, iwork, state, istate, beam, result, info)
        real(wp), intent(in) :: work(*), state(*)
        integer, intent(in) :: iwork(*), istate(*)
        type(prepared_type), intent(out) :: beam
        type(result_type), intent(out) :: result
        !> 0, -1, -3, or gapbeam_no_memory
        integer, intent(out) :: info

        call take_beam(work, iwork, 1, beam, info)
        if (info /= 0) return
        call take_result(state, istate, 3, result, info)
    end subroutine take_both

    !> A tape over two work arrays, just behind the header
    subroutine start(tape, mode, work, reals, iwork, integers)
        type(tape_type), intent(out) :: tape
        integer, intent(in) :: mode
        integer(int64), intent(in) :: reals, integers
        real(wp), intent(in), target :: work(*)
        integer, intent(in), target :: iwork(*)

        tape%mode = mode
        tape%integers = header
        call c_f_pointer(c_loc(work), tape%real_array, [reals])
        call c_f_pointer(c_loc(iwork), tape%integer_array, [integers])
    end subroutine start

end module gapbeam_work
