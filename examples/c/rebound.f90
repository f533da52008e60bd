! psi_2 of some impacts on the exact law, computed by Carom's C library.
program rebound
    use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int8_t, c_size_t
    implicit none
    interface
        integer(c_int) function carom_rebound(n, psi, chi, psi_out, status) bind(c)
            import :: c_double, c_int, c_int8_t, c_size_t
            integer(c_size_t), value :: n
            real(c_double), intent(in) :: psi(*), chi(*)
            real(c_double), intent(out) :: psi_out(*)
            integer(c_int8_t), intent(out) :: status(*)
        end function
    end interface
    real(c_double) :: psi(4) = [0.5d0, 1d0, 2d0, 6d0], chi(4) = 1.44d0, psi_out(4)
    integer(c_int8_t) :: status(4)
    integer :: i
    if (carom_rebound(4_c_size_t, psi, chi, psi_out, status) /= 0) stop 1
    do i = 1, 4
        print '(f4.1, f16.12, i3)', psi(i), psi_out(i), status(i)
    end do
end program
