#include "reliability/stop.h"

#include <math.h>

bool bt_stop_wanted(const bt_study* study) {
    return study->reliability.half_width > 0 || study->reliability.cov > 0;
}

double bt_stop_tail(const bt_study* study) {
    return bt_stop_wanted(study) ? 0.016 : 0.025;
}

bool bt_stop_reached(const bt_study* study, const bt_width* width) {
    const double half_width = study->reliability.half_width, cov = study->reliability.cov;
    const double widest = fmax(width->overall, width->largest);
    return !isnan(widest) && (half_width <= 0 || widest <= half_width) &&
           (cov <= 0 || width->cov <= cov);
}

bt_status bt_stop_check(const bt_study* study, bt_diag* diag) {
    if (bt_stop_wanted(study) && study->campaign.design != BT_DESIGN_CONDITIONS) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "reliability.%s needs campaign.design: conditions, whose landings come in "
                    "rounds; the design here is %s",
                    study->reliability.half_width > 0 ? "half_width" : "cov",
                    bt_design_names[study->campaign.design]);
        return BT_ERR_INPUT;
    }
    if (!bt_stop_wanted(study) && study->campaign.max_landings > 0) {
        bt_diag_add(
            diag, BT_ERROR, BT_NOWHERE,
            "campaign.max_landings needs reliability.half_width or reliability.cov; without "
            "them campaign.samples says how many");
        return BT_ERR_INPUT;
    }
    return BT_OK;
}
