!> The nodal mixed system as a yardstick, by 2x2 block elimination or by LAPACK's dgbsv.
!>
!> Rows and signs are those of gapbeam_band; every mesh point is a node with the unknowns (M, w). Refinement takes its
!> residual in plain double, with differences of neighbouring unknowns formed first, or in double-double.
module yardstick_mixed
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type, piece_type, piece_load_type, condense_link
    use gapbeam_band, only: node_type, rhs_type, pivot_type, chain_answer_type => answer_type, factor_chain, band_ok, plain, &
        restrained
    use gapbeam_band_substitution, only: solve_chain
    use gapbeam_residual, only: residual_chain, size_type
    use yardstick_beam, only: beam_type, answer_type, method_type, is_rigid, node_load, shear_reactions, solved, singular
    use yardstick_lapack, only: dgbsv, dgbtrs
    implicit none
    private
    public :: mixed_type, state_bytes

    !> Half bandwidth
    integer, parameter :: band = 3

    !> The method and its workspace
    type, extends(method_type) :: mixed_type
        !> By dgbsv, or else by the engine's elimination
        logical :: by_lapack = .false.
        !> Refinement steps, and whether their residuals are in double-double
        integer :: refinements = 0
        logical :: precise = .false.
        !> Are reactions wanted
        logical :: reactions = .true.
        real(wp), allocatable, private :: matrix(:, :), b(:, :), shear(:), uncertain(:)
        integer, allocatable, private :: pivot(:)
        type(link_type), allocatable, private :: links(:)
        type(node_type), allocatable, private :: nodes(:)
        type(rhs_type), allocatable, private :: rhs(:), eliminated(:)
        type(pivot_type), allocatable, private :: pivots(:)
        type(chain_answer_type), allocatable, private :: solution(:), correction(:)
        type(size_type), allocatable, private :: sizes(:)
    contains
        procedure :: solve
        procedure :: finish
    end type mixed_type

contains

    !> Bytes a node that the plain solve keeps, by the engine's elimination or by dgbsv
    pure function state_bytes(by_lapack) result(bytes)
        logical, intent(in) :: by_lapack
        integer :: bytes
        type(link_type) :: link
        type(node_type) :: node
        type(rhs_type) :: rhs
        type(pivot_type) :: pivot
        type(chain_answer_type) :: answer

        if (by_lapack) then  ! two unknowns: columns of the matrix, right-hand side, pivots
            bytes = 2*((3*band + 2)*storage_size(1.0_wp) + storage_size(1))/8
        else
            bytes = (storage_size(link) + storage_size(node) + 2*storage_size(rhs) + storage_size(pivot) + storage_size(answer))/8
        end if
    end function state_bytes

    !> Assemble, factor, solve
    subroutine solve(self, beam, closed, answer, status)
        class(mixed_type), intent(inout) :: self
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        type(answer_type), intent(in) :: answer
        integer, intent(out) :: status
        integer :: n, info, place

        n = size(beam%length)
        if (.not. allocated(self%shear)) allocate (self%shear(n), self%uncertain(n))
        if (.not. self%by_lapack .or. self%precise) call assemble_chain(self, beam, closed)
        if (self%by_lapack) then
            if (.not. allocated(self%matrix)) then
                allocate (self%matrix(3*band + 1, 2*(n + 1)), self%b(2*(n + 1), 1), self%pivot(2*(n + 1)))
            end if
            call assemble_band(beam, closed, self%matrix, self%b)
            call dgbsv(2*(n + 1), band, band, 1, self%matrix, 3*band + 1, self%pivot, self%b, 2*(n + 1), info)
            status = merge(solved, singular, info == 0)
            if (status /= solved) return
            answer%m = self%b(1::2, 1)
            answer%w = self%b(2::2, 1)
        else
            call factor_chain(self%nodes, self%links, self%pivots, info, place)
            status = merge(solved, singular, info == band_ok)
            if (status /= solved) return
            self%eliminated(:) = self%rhs
            call solve_chain(self%nodes, self%links, self%pivots, self%eliminated, self%solution)
            call take_solution(self, answer)
        end if
        if (self%reactions) call shear_reactions(beam, closed, answer, self%shear, self%uncertain)
    end subroutine solve

    !> Refine with the factor of the last solve
    subroutine finish(self, beam, closed, answer, status)
        class(mixed_type), intent(inout) :: self
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        type(answer_type), intent(in) :: answer
        integer, intent(out) :: status
        integer :: n, info, step, i

        status = solved
        n = size(beam%length)
        if (self%refinements == 0) return
        do step = 1, self%refinements
            if (self%precise) then
                if (self%by_lapack) call put_solution(self, answer)
                call residual_chain(self%nodes, self%links, self%rhs, self%solution, self%eliminated, self%sizes)
            else
                if (.not. allocated(self%b)) allocate (self%b(2*(n + 1), 1))
                call residual(beam, closed, answer, self%b)
            end if
            if (self%by_lapack) then
                if (self%precise) then
                    do i = 0, n
                        self%b(2*i + 1, 1) = self%eliminated(i)%left + self%eliminated(i)%right
                        self%b(2*i + 2, 1) = self%eliminated(i)%shear
                        call known_rows(beam, closed, answer, i, self%b(:, 1))
                    end do
                end if
                call dgbtrs("N", 2*(n + 1), band, band, 1, self%matrix, 3*band + 1, self%pivot, self%b, 2*(n + 1), info)
                answer%m = answer%m + self%b(1::2, 1)
                answer%w = answer%w + self%b(2::2, 1)
            else
                if (.not. self%precise) then
                    do i = 0, n
                        ! Known moments and deflections are exact in the elimination, their corrections are zero
                        self%eliminated(i) = rhs_type(right=self%b(2*i + 1, 1), shear=self%b(2*i + 2, 1))
                    end do
                    ! At a clamp on the right the row belongs to the left side
                    self%eliminated(n) = rhs_type(left=self%b(2*n + 1, 1), shear=self%b(2*n + 2, 1))
                end if
                call solve_chain(self%nodes, self%links, self%pivots, self%eliminated, self%correction)
                self%solution%deflection = self%solution%deflection + self%correction%deflection
                self%solution%moment_left = self%solution%moment_left + self%correction%moment_left
                self%solution%moment_right = self%solution%moment_right + self%correction%moment_right
                call take_solution(self, answer)
            end if
        end do
        if (self%reactions) call shear_reactions(beam, closed, answer, self%shear, self%uncertain)
    end subroutine finish

    !> The beam as the engine sees it when every mesh point is a node
    subroutine assemble_chain(self, beam, closed)
        class(mixed_type), intent(inout) :: self
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        type(piece_type) :: piece(1)
        type(piece_load_type) :: dead(1), live(1)
        real(wp) :: work(1)
        integer :: i, n

        n = size(beam%length)
        if (.not. allocated(self%links)) then
            allocate (self%links(n), self%nodes(0:n), self%rhs(0:n), self%eliminated(0:n), self%pivots(0:n))
            allocate (self%solution(0:n), self%correction(0:n), self%sizes(0:n))
        end if
        dead(1) = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
        do i = 1, n
            piece(1) = piece_type(beam%length(i), 1/beam%ei(i), 0.0_wp)
            live(1) = piece_load_type(beam%q(i), beam%q(i), 0.0_wp, 0.0_wp, 0.0_wp)
            call condense_link(piece, dead, live, work, self%links(i))
        end do
        do i = 0, n
            self%nodes(i) = node_type(kind=plain, held=is_rigid(beam%stiff(i), closed(i)))
            self%rhs(i) = rhs_type(shear=beam%force(i))
            if (i > 0) then
                self%rhs(i)%left = self%links(i)%turn_b(2)
                self%rhs(i)%shear = self%rhs(i)%shear - self%links(i)%shear_b(2)
            end if
            if (i < n) then
                self%rhs(i)%right = self%links(i + 1)%turn_a(2)
                self%rhs(i)%shear = self%rhs(i)%shear + self%links(i + 1)%shear_a(2)
            end if
            if (self%nodes(i)%held) then
                self%rhs(i)%deflection = beam%level(i)
            else if (closed(i)) then
                self%nodes(i)%stiffness = beam%stiff(i)
                self%rhs(i)%shear = self%rhs(i)%shear + beam%stiff(i)*beam%level(i)
            end if
        end do
        if (beam%clamped(1)) self%nodes(0)%kind = restrained
        if (beam%clamped(2)) self%nodes(n)%kind = restrained
    end subroutine assemble_chain

    !> From the engine's records into plain arrays; the moment at a clamp is that on the beam's side
    subroutine take_solution(self, answer)
        class(mixed_type), intent(in) :: self
        type(answer_type), intent(in) :: answer
        integer :: n

        n = size(self%links)
        answer%w = self%solution%deflection
        answer%m = self%solution%moment_right
        answer%m(n) = self%solution(n)%moment_left
    end subroutine take_solution

    !> The way back
    pure subroutine put_solution(self, answer)
        class(mixed_type), intent(inout) :: self
        type(answer_type), intent(in) :: answer
        integer :: n

        n = size(self%links)
        self%solution%deflection = answer%w
        self%solution%moment_left = answer%m
        self%solution%moment_right = answer%m
        self%solution(0)%moment_left = 0.0_wp
        self%solution(n)%moment_right = 0.0_wp
    end subroutine put_solution

    !> Band matrix in LAPACK's storage, element (i, j) in row 2*band + 1 + i - j of column j, and right-hand side
    subroutine assemble_band(beam, closed, matrix, b)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        real(wp), intent(out) :: matrix(:, :), b(:, :)
        real(wp) :: h, f, turn
        integer :: i, n, m, w

        n = size(beam%length)
        matrix = 0.0_wp
        b = 0.0_wp
        do i = 0, n
            m = 2*i + 1
            w = m + 1
            if (i == 0 .or. i == n) then
                if (.not. beam%clamped(1 + i/n)) call put(m, m, 1.0_wp)
            end if
            if (is_rigid(beam%stiff(i), closed(i))) then
                call put(w, w, 1.0_wp)
                b(w, 1) = beam%level(i)
            else
                b(w, 1) = node_load(beam, i)
                if (closed(i)) then
                    call put(w, w, beam%stiff(i))
                    b(w, 1) = b(w, 1) + beam%stiff(i)*beam%level(i)
                end if
            end if
        end do
        do i = 1, n
            h = 1/beam%length(i)
            f = beam%length(i)/(6*beam%ei(i))
            turn = beam%q(i)*beam%length(i)**3/(24*beam%ei(i))
            m = 2*i - 1
            w = m + 1
            ! Compatibility: rotation on the left less rotation on the right
            if (i > 1 .or. beam%clamped(1)) then
                call put(m, m, -2*f)
                call put(m, m + 2, -f)
                call put(m, w, h)
                call put(m, w + 2, -h)
                b(m, 1) = b(m, 1) + turn
            end if
            if (i < n .or. beam%clamped(2)) then
                call put(m + 2, m, -f)
                call put(m + 2, m + 2, -2*f)
                call put(m + 2, w, -h)
                call put(m + 2, w + 2, h)
                b(m + 2, 1) = b(m + 2, 1) + turn
            end if
            ! Equilibrium: shear on the left less shear on the right
            if (.not. is_rigid(beam%stiff(i - 1), closed(i - 1))) then
                call put(w, m, h)
                call put(w, m + 2, -h)
            end if
            if (.not. is_rigid(beam%stiff(i), closed(i))) then
                call put(w + 2, m, -h)
                call put(w + 2, m + 2, h)
            end if
        end do

    contains

        !> Add to an element
        subroutine put(row, column, value)
            integer, intent(in) :: row, column
            real(wp), intent(in) :: value

            matrix(2*band + 1 + row - column, column) = matrix(2*band + 1 + row - column, column) + value
        end subroutine put

    end subroutine assemble_band

    !> What the rows still lack, in plain double, differences of neighbouring unknowns first
    subroutine residual(beam, closed, answer, b)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        type(answer_type), intent(in) :: answer
        real(wp), intent(out) :: b(:, :)
        real(wp) :: psi_left, psi_right, v_left, v_right, slope, f, turn, after
        integer :: i, n

        n = size(beam%length)
        psi_left = 0.0_wp
        v_left = 0.0_wp
        after = 0.0_wp
        do i = 0, n
            psi_right = 0.0_wp
            v_right = 0.0_wp
            if (i < n) then
                slope = (answer%w(i + 1) - answer%w(i))/beam%length(i + 1)
                f = beam%length(i + 1)/(6*beam%ei(i + 1))
                turn = beam%q(i + 1)*beam%length(i + 1)**3/(24*beam%ei(i + 1))
                psi_right = slope + (f*(2*answer%m(i) + answer%m(i + 1)) + turn)
                after = slope - (f*(answer%m(i) + 2*answer%m(i + 1)) + turn)
                v_right = (answer%m(i + 1) - answer%m(i))/beam%length(i + 1)
            end if
            b(2*i + 1, 1) = psi_right - psi_left
            b(2*i + 2, 1) = (v_right - v_left) + node_load(beam, i)
            if (closed(i) .and. .not. is_rigid(beam%stiff(i), .true.)) b(2*i + 2, 1) = b(2*i + 2, 1) &
                - beam%stiff(i)*(answer%w(i) - beam%level(i))
            call known_rows(beam, closed, answer, i, b(:, 1))
            psi_left = after
            v_left = v_right
        end do
    end subroutine residual

    !> Residuals where the moment or the deflection is known: after pivoting these are not satisfied exactly either
    subroutine known_rows(beam, closed, answer, i, b)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        type(answer_type), intent(in) :: answer
        !> The node, from 0
        integer, intent(in) :: i
        !> All residuals
        real(wp), intent(inout) :: b(:)
        integer :: n

        n = size(beam%length)
        if (i == 0 .or. i == n) then
            if (.not. beam%clamped(1 + i/n)) b(2*i + 1) = -answer%m(i)
        end if
        if (is_rigid(beam%stiff(i), closed(i))) b(2*i + 2) = beam%level(i) - answer%w(i)
    end subroutine known_rows

end module yardstick_mixed
