/* Return psi_2 at chi = $chi, e = $restitution; NaN of NaN. */
static inline double $name(double psi)
{
    enum { panels = $panels, terms = $terms };
    /* where panels begin, the first also taking what lies below, and where the last one ends */
    static const double edges[panels + 1] = {
$edges
    };
    /* place = slope x + shift goes from -1 to 1 over a panel */
    static const double places[panels][2] = {
$places
    };
    /* 1 - r in rising powers of the place */
    static const double powers[panels][terms] = {
$powers
    };
    const double limit = $limit; /* 2 chi (1 + e): psi_1 - psi_2 in gross slip */
    const double size = psi < 0.0 ? -psi : psi;
    double place, part, lost;
    int low = 0, high = panels, middle, k;

    if (size >= edges[panels])
        return psi < 0.0 ? psi + limit : psi - limit;
    while (high - low > 1) {
        middle = (low + high) / 2;
        if (size < edges[middle])
            high = middle;
        else
            low = middle;
    }
    place = places[low][0] * size + places[low][1];
    part = powers[low][terms - 1];
    for (k = terms - 2; k >= 0; --k)
        part = part * place + powers[low][k];
    part = part < 0.0 ? 0.0 : part > 2.0 ? 2.0 : part; /* beyond, energy would grow */
    lost = part * size > limit ? limit : part * size;
    return psi < 0.0 ? psi + lost : psi - lost;
}
