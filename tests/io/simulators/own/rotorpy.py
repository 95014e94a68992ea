"""
Parameters of my quadrotor. d = 0.043 is what the ruler says.
"""
import numpy as np

d = 0.043  # Arm length

quad_params = {

    # Inertial properties
    'mass': 0.03,       # kg
    'Ixx':  1.43e-5,    # kg*m^2
    'Iyy':  1.43e-5,
    'Izz':  2.89e-5,
    'Ixy':  0.0, 'Iyz':  0.0, 'Ixz':  0.0,

    'num_rotors': 4,
    'rotor_pos': {
                    'r1': d*np.array([ 0.70710678118, 0.70710678118, 0]),
                    'r2': d*np.array([ 0.70710678118,-0.70710678118, 0]),
                    'r3': d*np.array([-0.70710678118,-0.70710678118, 0]),
                    'r4': d*np.array([-0.70710678118, 0.70710678118, 0]),
                 },
    'rotor_directions': np.array([1,-1,1,-1]),
    'rI': np.array([0,0,0]),

    'c_Dx': 0.0, 'c_Dy': 0.0, 'c_Dz': 0.0,

    # Rotor properties (Forster 2015)
    'k_eta': 2.3e-08,           # thrust coefficient N/(rad/s)**2
    'k_m':   7.8e-10,
    'k_d':   10.2506e-07,
    'k_z':   7.553e-07,
    'k_h':   0.0,
    'k_flap': 0.0,

    'tau_m': 0.072,           # motor response time, seconds
    'rotor_speed_min': 0,
    'rotor_speed_max': 2500,
    'motor_noise_std': 0.0,

    'k_w': 1, 'k_v': 10, 'kp_att': 1030, 'kd_att': 51,
}
