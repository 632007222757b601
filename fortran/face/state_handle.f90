!> Solved states as numbers that Python keeps, and their fields at the pieces: nothing is written to them once they are made, so
!> that threads may share them
module gapbeam_state_handle
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved
    use gapbeam_element, only: field_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_query, only: find_starts
    use gapbeam_ground_solver, only: ground_solution_type
    implicit none
    private
    public :: state_handle_type, solve_and_keep, state_of, drop_state
    public :: fields_handle_type, recover_and_keep, fields_of, drop_fields, pack_ground

    !> Rows of a solution on the ground as an array, beside those of the layers
    integer, parameter :: ground_rows = 19

    !> What a handle of a state stands for
    type :: state_handle_type
        type(state_type) :: state
    end type state_handle_type

    !> What a handle of fields stands for: those at the left end of every piece, none on the ground
    type :: fields_handle_type
        type(field_type), allocatable :: starts(:)
    end type fields_handle_type

contains

    !> Solve at one load factor and keep the state
    subroutine solve_and_keep(lowered, factor, rule, on_laws, closed, address, error)
        !> The beam
        type(assembled_type), intent(in) :: lowered
        !> As for solve_state
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> On the smooth laws themselves, or on the polylines in place of them
        logical, intent(in) :: on_laws
        !> Scheme that the search starts from
        logical, intent(in) :: closed(:)
        !> The handle; 0 where an error is found
        integer(int64), intent(out) :: address
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(state_handle_type), pointer :: handle
        integer :: stat

        address = 0
        allocate (handle, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call new_state(lowered, handle%state, error)
        if (.not. allocated(error)) then
            handle%state%closed(:) = closed
            if (on_laws) then
                call solve_on_laws(lowered, factor, rule, handle%state, error)
            else
                call solve_state(lowered, factor, rule, handle%state, error)
            end if
        end if
        if (allocated(error)) then
            deallocate (handle)
            return
        end if
        ! What is not looked at here
        deallocate (handle%state%starts)
        if (handle%state%status == gapbeam_solved) deallocate (handle%state%motion)
        address = transfer(c_loc(handle), address)
    end subroutine solve_and_keep

    !> What a handle of a state stands for
    function state_of(address) result(handle)
        integer(int64), intent(in) :: address
        type(state_handle_type), pointer :: handle

        call c_f_pointer(transfer(address, c_null_ptr), handle)
    end function state_of

    !> Free it; the handle is worth nothing from then on
    subroutine drop_state(address)
        integer(int64), intent(in) :: address
        type(state_handle_type), pointer :: handle

        handle => state_of(address)
        if (associated(handle)) deallocate (handle)
    end subroutine drop_state

    !> Recover the fields of a state at the pieces and keep them
    subroutine recover_and_keep(lowered, state, address, error)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: lowered
        type(state_type), intent(in) :: state
        !> The handle; 0 where an error is found
        integer(int64), intent(out) :: address
        !> A field out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(fields_handle_type), pointer :: handle
        integer :: stat

        address = 0
        allocate (handle, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        allocate (handle%starts(merge(0, size(lowered%pieces), allocated(state%ground))), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
        else if (.not. allocated(state%ground)) then
            call find_starts(lowered, state, handle%starts, error)
        end if
        if (allocated(error)) then
            deallocate (handle)
        else
            address = transfer(c_loc(handle), address)
        end if
    end subroutine recover_and_keep

    !> What a handle of fields stands for
    function fields_of(address) result(handle)
        integer(int64), intent(in) :: address
        type(fields_handle_type), pointer :: handle

        call c_f_pointer(transfer(address, c_null_ptr), handle)
    end function fields_of

    !> Free it; the handle is worth nothing from then on
    subroutine drop_fields(address)
        integer(int64), intent(in) :: address
        type(fields_handle_type), pointer :: handle

        handle => fields_of(address)
        if (associated(handle)) deallocate (handle)
    end subroutine drop_fields

    !> A solution on the ground as an array, a column a stretch
    pure subroutine pack_ground(solution, values)
        type(ground_solution_type), intent(in) :: solution
        !> Piece; distances of the ends from its left end, length; moduli; loads qa, qb, qc, kappa; deflections, moments,
        !> rotations, shears of the ends; of every layer the force up, and the piece of its law on which it acts (0: none)
        real(wp), intent(out) :: values(:, :)
        integer :: i, n

        n = size(solution%acts, 1)
        do i = 1, size(solution%piece)
            associate (s => solution%stretches(i), q => solution%loads(i), e => solution%ends(i))
                values(:ground_rows, i) = [real(solution%piece(i), wp), solution%from(i), solution%to(i), s%length, s%modulus_a, &
                                           s%modulus_b, q%qa, q%qb, q%qc, q%kappa, e%w_a, e%w_b, e%moment_a, e%moment_b, &
                                           solution%rotation(:, i), solution%shear(:, i), solution%slope(i)]
            end associate
            values(ground_rows + 1:ground_rows + n, i) = solution%resultant(:, i)
            values(ground_rows + n + 1:ground_rows + 2*n, i) = solution%acts(:, i)
        end do
    end subroutine pack_ground

end module gapbeam_state_handle
