!> Prepared beams and states in the work arrays of the Fortran 77 interface: how much they take, put in, taken out
module gapbeam_work
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_no_memory, gapbeam_not_prepared
    use gapbeam_search, only: rule_block, rule_single
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_api, only: prepared_type, result_type
    use gapbeam_tape, only: tape_type, writing, reading
    use gapbeam_pack, only: exchange_beam, exchange_state
    implicit none
    private
    public :: sizes_of_beam, sizes_of_state, put_beam, take_beam, put_result, take_result, begin_result, take_both

    !> Marks of what a pair of work arrays holds, in the first integer; the next two are the lengths used
    integer, parameter :: beam_mark = 770042, state_mark = 770043, header = 3

contains

    !> Lengths that are enough for any beam of these sizes
    pure subroutine sizes_of_beam(spans, hinges, supports, loads, reals, integers)
        integer, intent(in) :: spans, hinges, supports, loads
        !> Lengths of the two work arrays
        integer(int64), intent(out) :: reals, integers
        integer(int64) :: points, nodes

        ! No more points than places given, no more nodes than hinges, supports and places of loads beside the two ends
        points = 1_int64 + spans + hinges + supports + 2_int64*loads
        nodes = min(points, 2_int64 + hinges + supports + 2_int64*loads)
        reals = 5_int64*spans + hinges + 8_int64*supports + 4_int64*loads + 25*points + 27*nodes + 16
        integers = header + 2_int64*spans + 11_int64*supports + 5_int64*loads + 4*points + 3*nodes + 60
    end subroutine sizes_of_beam

    !> Lengths that a state of a beam takes
    subroutine sizes_of_state(beam, reals, integers, error)
        type(prepared_type), intent(in) :: beam
        integer(int64), intent(out) :: reals, integers
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(tape_type) :: tape
        type(state_type) :: state

        reals = 0
        integers = 0
        call new_state(beam%lowered, state, error)
        if (allocated(error)) return
        call exchange_state(tape, state)
        reals = tape%reals
        integers = tape%integers + header
    end subroutine sizes_of_state

    !> Put a prepared beam into work arrays
    subroutine put_beam(beam, work, lwork, iwork, liwork, fits)
        type(prepared_type), intent(inout) :: beam
        integer, intent(in) :: lwork, liwork
        real(wp), intent(inout), target :: work(*)
        integer, intent(inout), target :: iwork(*)
        !> False where they are too short; nothing is written then
        logical, intent(out) :: fits
        type(tape_type) :: tape

        call exchange_beam(tape, beam%lowered)
        fits = tape%reals <= lwork .and. tape%integers + header <= liwork
        if (.not. fits) return
        call start(tape, writing, work, int(lwork, int64), iwork, int(liwork, int64))
        iwork(1:header) = [beam_mark, lwork, liwork]
        call exchange_beam(tape, beam%lowered)
    end subroutine put_beam

    !> Take a prepared beam out of work arrays
    subroutine take_beam(work, iwork, beam, error)
        real(wp), intent(in), target :: work(*)
        integer, intent(in), target :: iwork(*)
        type(prepared_type), intent(out) :: beam
        !> Nothing prepared in there, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(tape_type) :: tape
        integer :: stat

        if (iwork(1) /= beam_mark) then
            call fatal_error(error, gapbeam_not_prepared, "no beam in the work arrays")
            return
        end if
        allocate (beam%lowered, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call start(tape, reading, work, int(iwork(2), int64), iwork, int(iwork(3), int64))
        call exchange_beam(tape, beam%lowered)
        if (tape%stat /= 0) call no_memory(error)
    end subroutine take_beam

    !> Put a result into work arrays
    subroutine put_result(result, work, lwork, iwork, liwork, fits)
        type(result_type), intent(inout) :: result
        integer, intent(in) :: lwork, liwork
        real(wp), intent(inout), target :: work(*)
        integer, intent(inout), target :: iwork(*)
        !> False where they are too short; nothing is written then
        logical, intent(out) :: fits
        type(tape_type) :: tape

        call exchange_state(tape, result%state)
        fits = tape%reals <= lwork .and. tape%integers + header <= liwork
        if (.not. fits) return
        call start(tape, writing, work, int(lwork, int64), iwork, int(liwork, int64))
        iwork(1:header) = [state_mark, lwork, liwork]
        call exchange_state(tape, result%state)
    end subroutine put_result

    !> Take a result out of work arrays
    subroutine take_result(work, iwork, result, error)
        real(wp), intent(in), target :: work(*)
        integer, intent(in), target :: iwork(*)
        type(result_type), intent(out) :: result
        !> Nothing solved in there, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(tape_type) :: tape
        integer :: stat

        if (iwork(1) /= state_mark) then
            call fatal_error(error, gapbeam_not_prepared, "no state in the work arrays")
            return
        end if
        allocate (result%state, stat=stat)
        if (stat == 0) then
            call start(tape, reading, work, int(iwork(2), int64), iwork, int(iwork(3), int64))
            call exchange_state(tape, result%state)
        else
            tape%stat = stat
        end if
        if (tape%stat /= 0) then
            call no_memory(error)
            return
        end if
        associate (state => result%state)
            result%status = state%status
            result%factor = state%factor
            result%solves = state%solves
            result%method = state%method
            result%indifferent = state%indifferent
            result%slides = state%slides
        end associate
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

        info = 0
        call take_beam(work, iwork, beam, error)
        if (allocated(error)) then
            info = merge(error%code, -1, error%code == gapbeam_no_memory)
            return
        end if
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
    end subroutine begin_result

    !> Beam and state, for the routines that have them as their first four arguments
    subroutine take_both(work, iwork, state, istate, beam, result, info)
        real(wp), intent(in) :: work(*), state(*)
        integer, intent(in) :: iwork(*), istate(*)
        type(prepared_type), intent(out) :: beam
        type(result_type), intent(out) :: result
        !> 0, -1, -3, or gapbeam_no_memory
        integer, intent(out) :: info
        type(error_type), allocatable :: error

        info = 0
        call take_beam(work, iwork, beam, error)
        if (allocated(error)) then
            info = merge(error%code, -1, error%code == gapbeam_no_memory)
            return
        end if
        call take_result(state, istate, result, error)
        if (allocated(error)) info = merge(error%code, -3, error%code == gapbeam_no_memory)
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
