// Formats copied from a public log of release 1.15; parameters with the firmware's defaults where nothing
// says otherwise.
#include "px4_facts.h"

namespace written {
namespace {

constexpr const char* kFormats[] = {
    "vehicle_angular_velocity:uint64_t timestamp;uint64_t timestamp_sample;float[3] xyz;float[3] "
    "xyz_derivative;",
    "sensor_combined:uint64_t timestamp;float[3] gyro_rad;uint32_t gyro_integral_dt;"
    "int32_t accelerometer_timestamp_relative;float[3] accelerometer_m_s2;uint32_t accelerometer_integral_dt;"
    "uint8_t accelerometer_clipping;uint8_t gyro_clipping;uint8_t accel_calibration_count;"
    "uint8_t gyro_calibration_count;",
    "vehicle_acceleration:uint64_t timestamp;uint64_t timestamp_sample;float[3] xyz;uint8_t[4] _padding0;",
    "vehicle_attitude:uint64_t timestamp;uint64_t timestamp_sample;float[4] q;float[4] delta_q_reset;"
    "uint8_t quat_reset_counter;uint8_t[7] _padding0;",
    "vehicle_local_position:uint64_t timestamp;uint64_t timestamp_sample;uint64_t ref_timestamp;double "
    "ref_lat;"
    "double ref_lon;float x;float y;float z;float[2] delta_xy;float delta_z;float vx;float vy;float vz;"
    "float z_deriv;float[2] delta_vxy;float delta_vz;float ax;float ay;float az;float heading;float "
    "heading_var;"
    "float unaided_heading;float delta_heading;float tilt_var;float ref_alt;float dist_bottom;float "
    "eph;float epv;"
    "float evh;float evv;float vxy_max;float vz_max;float hagl_min;float hagl_max;bool xy_valid;bool z_valid;"
    "bool v_xy_valid;bool v_z_valid;uint8_t xy_reset_counter;uint8_t z_reset_counter;uint8_t "
    "vxy_reset_counter;"
    "uint8_t vz_reset_counter;uint8_t heading_reset_counter;bool heading_good_for_control;bool xy_global;"
    "bool z_global;bool dist_bottom_valid;uint8_t dist_bottom_sensor_bitfield;bool dead_reckoning;"
    "uint8_t[5] _padding0;",
    "vehicle_torque_setpoint:uint64_t timestamp;uint64_t timestamp_sample;float[3] xyz;uint8_t[4] _padding0;",
    "vehicle_thrust_setpoint:uint64_t timestamp;uint64_t timestamp_sample;float[3] xyz;uint8_t[4] _padding0;",
    "actuator_motors:uint64_t timestamp;uint64_t timestamp_sample;float[12] control;uint16_t "
    "reversible_flags;"
    "uint8_t[6] _padding0;",
    "battery_status:uint64_t timestamp;float voltage_v;float voltage_filtered_v;float current_a;"
    "float current_filtered_a;float current_average_a;float discharged_mah;float remaining;float scale;"
    "float time_remaining_s;float temperature;float[14] voltage_cell_v;float max_cell_voltage_delta;"
    "uint32_t custom_faults;float average_power;float available_energy;float full_charge_capacity_wh;"
    "float remaining_capacity_wh;float design_capacity;float nominal_voltage;uint16_t capacity;"
    "uint16_t cycle_count;uint16_t average_time_to_empty;uint16_t serial_number;uint16_t manufacture_date;"
    "uint16_t state_of_health;uint16_t max_error;uint16_t interface_error;uint16_t faults;"
    "uint16_t average_time_to_full;uint16_t over_discharge_count;bool connected;uint8_t cell_count;uint8_t "
    "source;"
    "uint8_t priority;uint8_t id;bool is_powering_off;bool is_required;uint8_t warning;uint8_t mode;"
    "uint8_t[1] _padding0;",
    "esc_report:uint64_t timestamp;uint32_t esc_errorcount;int32_t esc_rpm;float esc_voltage;float "
    "esc_current;"
    "float esc_temperature;uint16_t failures;uint8_t esc_address;uint8_t esc_cmdcount;uint8_t esc_state;"
    "uint8_t actuator_function;int8_t esc_power;uint8_t[5] _padding0;",
    "esc_status:uint64_t timestamp;uint16_t counter;uint8_t esc_count;uint8_t esc_connectiontype;"
    "uint8_t esc_online_flags;uint8_t esc_armed_flags;uint8_t[2] _padding0;esc_report[8] esc;",
    "vehicle_land_detected:uint64_t timestamp;bool freefall;bool ground_contact;bool maybe_landed;bool "
    "landed;"
    "bool in_ground_effect;bool in_descend;bool has_low_throttle;bool vertical_movement;bool "
    "horizontal_movement;"
    "bool rotational_movement;bool close_to_ground_or_skipped_check;bool at_rest;uint8_t[4] _padding0;",
    "vehicle_status:uint64_t timestamp;uint64_t armed_time;uint64_t takeoff_time;uint64_t "
    "nav_state_timestamp;"
    "uint32_t valid_nav_states_mask;uint32_t can_set_nav_states_mask;uint16_t failure_detector_status;"
    "uint8_t arming_state;uint8_t latest_arming_reason;uint8_t latest_disarming_reason;"
    "uint8_t nav_state_user_intention;uint8_t nav_state;uint8_t executor_in_charge;uint8_t hil_state;"
    "uint8_t vehicle_type;bool failsafe;bool failsafe_and_user_took_over;uint8_t failsafe_defer_state;"
    "bool gcs_connection_lost;uint8_t gcs_connection_lost_counter;bool high_latency_data_link_lost;bool "
    "is_vtol;"
    "bool is_vtol_tailsitter;bool in_transition_mode;bool in_transition_to_fw;uint8_t system_type;"
    "uint8_t system_id;uint8_t component_id;bool safety_button_available;bool safety_off;bool "
    "power_input_valid;"
    "bool usb_connected;bool open_drone_id_system_present;bool open_drone_id_system_healthy;"
    "bool parachute_system_present;bool parachute_system_healthy;bool avoidance_system_required;"
    "bool avoidance_system_valid;bool rc_calibration_in_progress;bool calibration_enabled;"
    "bool pre_flight_checks_pass;uint8_t[4] _padding0;",
    "vehicle_control_mode:uint64_t timestamp;bool flag_armed;bool flag_multicopter_position_control_enabled;"
    "bool flag_control_manual_enabled;bool flag_control_auto_enabled;bool flag_control_offboard_enabled;"
    "bool flag_control_position_enabled;bool flag_control_velocity_enabled;bool "
    "flag_control_altitude_enabled;"
    "bool flag_control_climb_rate_enabled;bool flag_control_acceleration_enabled;"
    "bool flag_control_attitude_enabled;bool flag_control_rates_enabled;bool flag_control_allocation_enabled;"
    "bool flag_control_termination_enabled;uint8_t source_id;uint8_t[1] _padding0;",
    "actuator_armed:uint64_t timestamp;bool armed;bool prearmed;bool ready_to_arm;bool lockdown;"
    "bool manual_lockdown;bool force_failsafe;bool in_esc_calibration_mode;uint8_t[1] _padding0;",
    "vehicle_rates_setpoint:uint64_t timestamp;float roll;float pitch;float yaw;float[3] thrust_body;"
    "bool reset_integral;uint8_t[7] _padding0;",
};

void put_rotors(UlogFile& log, const Vehicle& v) {
  log.parameter("CA_AIRFRAME", 0);
  log.parameter("CA_METHOD", 2);
  log.parameter("CA_ROTOR_COUNT", 4);
  log.parameter("CA_R_REV", 0);
  for (size_t n = 0; n < 4; ++n) {
    const std::string rotor = "CA_ROTOR" + std::to_string(n) + "_";
    const Vector3d& r = v.rotors[n].r_B;
    log.parameter(rotor + "AX", 0.0f), log.parameter(rotor + "AY", 0.0f), log.parameter(rotor + "AZ", -1.0f);
    log.parameter(rotor + "CT", 6.5f), log.parameter(rotor + "KM", static_cast<float>(0.05 * v.rotors[n].s));
    log.parameter(rotor + "PX", static_cast<float>(r.x())),
        log.parameter(rotor + "PY", static_cast<float>(r.y()));
    log.parameter(rotor + "PZ", static_cast<float>(r.z()));
    log.parameter("CA_R" + std::to_string(n) + "_SLEW", 0.0f);
    log.parameter("PWM_MAIN_FUNC" + std::to_string(n + 1), static_cast<std::int32_t>(101 + n));
  }
}

}  // namespace

void put_px4_facts(UlogFile& log, const Flight& flight, const Logging& logging) {
  for (const char* format : kFormats) log.define(format);
  log.info("ver_sw", "1dacb4cdef2d7145754fc788fa8dc482eed74b40");
  log.info("uint32_t ver_sw_release", Bytes().put(std::uint32_t{0x010f00ff}));
  log.info("ver_hw", "PX4_FMU_V6C");
  log.info("ver_hw_subtype", "V6C002001");
  log.info("sys_name", "PX4");
  log.info("sys_os_name", "NuttX");
  log.info("sys_uuid", "000600000000313138373333510200430021");
  log.info("int32_t time_ref_utc", Bytes().put(std::int32_t{0}));

  const Vehicle& v = flight.v;
  log.parameter("SYS_AUTOSTART", 4001);
  log.parameter("MAV_TYPE", 2);
  log.parameter("SDLOG_PROFILE", logging.fast ? 9 : 1);
  log.parameter("SDLOG_MODE", 0);
  log.parameter("IMU_GYRO_CUTOFF", static_cast<float>(v.gyro_hz));
  log.parameter("IMU_DGYRO_CUTOFF", 30.0f);
  log.parameter("IMU_ACCEL_CUTOFF", static_cast<float>(v.accel_hz));
  log.parameter("IMU_GYRO_RATEMAX", 400);
  log.parameter("IMU_INTEG_RATE", 200);
  log.parameter("IMU_GYRO_NF0_FRQ", 0.0f);
  log.parameter("IMU_GYRO_NF1_FRQ", 0.0f);
  log.parameter("IMU_GYRO_DNF_EN", 0);
  log.parameter("IMU_GYRO_FFT_EN", 0);
  log.parameter("THR_MDL_FAC", static_cast<float>(v.thrust_model));
  log.parameter("MC_AIRMODE", 0);
  log.parameter("MC_BAT_SCALE_EN", 0);
  log.parameter("MPC_THR_HOVER", 0.5f);
  log.parameter("EKF2_IMU_POS_X", 0.0f);
  log.parameter("EKF2_IMU_POS_Y", 0.0f);
  log.parameter("EKF2_IMU_POS_Z", 0.0f);
  log.parameter("BAT1_N_CELLS", 4);
  log.parameter("BAT1_V_CHARGED", 4.05f);
  log.parameter("BAT1_V_EMPTY", 3.6f);
  if (logging.rotor_speeds) log.parameter("DSHOT_TEL_CFG", 102), log.parameter("MOT_POLE_COUNT", 14);
  put_rotors(log, v);
  log.default_parameter("IMU_GYRO_CUTOFF", 40.0f);
  log.default_parameter("IMU_ACCEL_CUTOFF", 30.0f);
}

}  // namespace written
