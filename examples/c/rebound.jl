# psi_2 of some impacts on the exact law, computed by Carom's C library:
# julia rebound.jl $(python -c "import carom; print(carom.get_library())")
psi, chi = [0.5, 1.0, 2.0, 6.0], fill(1.44, 4)
psi_out, status = similar(psi), zeros(Int8, 4)
failed = @ccall $(Libc.Libdl.dlsym(Libc.Libdl.dlopen(ARGS[1]), :carom_rebound))(
    length(psi)::Csize_t, psi::Ptr{Cdouble}, chi::Ptr{Cdouble}, psi_out::Ptr{Cdouble},
    status::Ptr{Int8})::Cint
failed == 0 || exit(1)
foreach(println, zip(psi, psi_out, status))
